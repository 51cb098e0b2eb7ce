/* SPDX-License-Identifier: MIT */
/* live.js - the picture that the module draws in place of the recorded frame. The pointer turns, moves and zooms the
 * picture. A click identifies the elements at a pixel. */
"use strict";

const DEGREES_A_PIXEL = 0.3;
const ZOOM_A_NOTCH = 1.0015; /* the zoom factor for a wheel delta of 1 */
const ZOOMS = [0.001, 1e6];  /* the smallest and the largest value of --zoom */
const CLICK = 4;             /* CSS pixels: if a pointer moves less between down and up, it is a click */
const PICK_RADIUS = 5;       /* CSS pixels */
const MARK_RADIUS = 9;       /* CSS pixels */
const KEY_STEP = 16;         /* pixels of the picture: a key turns the camera as much as dragging by this distance */
const SMOOTH = 10;           /* ms for a picture; if it takes longer, a moving view is drawn with fewer pixels */
const SLOW = 50;             /* ms; if two pictures with fewer pixels take longer, the next has still fewer */
const COARSE = 0.5;          /* the first scale of a picture with fewer pixels; see glide() */
const COARSEST = 0.25;       /* the smallest scale */
const COARSER = 0.7;         /* the factor from one scale to the next smaller one */
const REST = 100;            /* ms after which a view that moved is drawn with all pixels */
const SUITED_HEIGHT = 720;   /* lines and letters of the picture look as in a frame of this height, in CSS pixels */
const MOST_SIDE = 16384;     /* the longest side of a picture in samples (VIEW_MAX_SIDE in scene/view.h) */

const MARK_COLOR = "#ffffff";

const BOX_EDGES = [0, 1, 2, 3].flatMap(i => [[i, i + 4], [2 * i, 2 * i + 1], [i + (i & 2), i + (i & 2) + 2]]);

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
/* Numbers for a command line. 8 digits are enough for angles and sizes. A position far from the origin needs 15. */
const rounded = number => Number(number.toPrecision(8));
const roundedPlace = number => Number(number.toPrecision(15));

class Live {
    /* `showStatus(text)` shows a sentence. `picked(pick, place, ray)` shows the elements at a pixel, through
     * which a ray passes. `changed()` is called
     * after the view has changed. `again()` plays from tick 0 to the shown tick once more. `appears()` is called before
     * the picture takes the stage. `showRows(rows)` shows the rows of the column of text. */
    constructor(stage, player, {showStatus, picked, changed, again, appears, showRows})
    {
        this.stage = stage;
        this.player = player;
        this.showStatus = showStatus;
        this.picked = picked;
        this.changed = changed;
        this.again = again;
        this.appears = appears;
        this.showRows = showRows;
        this.exact = false; /* true: the picture has the size and the text of a recorded frame */
        this.scale = 1;     /* pixels of the picture for each pixel of the screen, on one axis; see glide() */
        this.cost = 0;      /* ms that the last picture with all pixels took */
        this.coarse = COARSE; /* the scale while the view moves */
        this.observer = new ResizeObserver(() => this.isShown && !this.exact && this.draw());
        this.observer.observe(stage);
        this.recorded = player.engine.view;
        this.canvas = element("canvas", "", {class: "live", role: "img"});
        this.marks = element("canvas", "", {class: "marks", "aria-hidden": "true"});
        this.measured = [];  /* the positions between which a line is drawn, at most two */
        this.subject = null; /* the marked element, as {node}, {foreign_node}, {point} or {query}; null: no element */
        this.pointers = new Map();
    }

    get engine()
    {
        return this.player.engine;
    }

    get view()
    {
        return this.engine.view;
    }

    /* The camera of the last drawn picture. If there is no picture yet, it is drawn first. */
    get camera()
    {
        if (!this.seen)
            this.drawNow();
        return this.seen;
    }

    get isShown()
    {
        return this.canvas.isConnected;
    }

    /* Stop drawing. The last picture stays on the stage until another one replaces it. */
    end()
    {
        this.observer.disconnect();
        this.ended = true;
    }

    /* Pixels of the picture for each CSS pixel. */
    get ratio()
    {
        return this.exact ? 1 : devicePixelRatio * this.scale;
    }

    /* The size of the picture: it fills the stage, unless it is exact. */
    get size()
    {
        const {clientWidth, clientHeight} = this.stage, most = Math.floor(MOST_SIDE / (this.view.aa ?? 1));
        const fill = side => clamp(Math.round(side * this.ratio), 1, most);
        return this.exact ? this.view.size : [fill(clientWidth), fill(clientHeight)];
    }

    /* ---- Drawing ----------------------------------------------------------------------------------------------- */

    /* Draw the picture at the next animation frame, so that several changes make only one picture. */
    draw()
    {
        this.stale = true; /* drawNow() clears this, perhaps before the animation frame */
        this.waiting ??= new Promise(done => requestAnimationFrame(() => {
            this.waiting = undefined;
            if (this.stale)
                this.drawNow();
            done();
        }));
        return this.waiting;
    }

    drawNow()
    {
        const start = performance.now();
        this.stale = false;
        if (this.ended)
            return;
        try {
            const picture = this.exact ? this.engine.draw()
                                       : this.engine.drawAt(...this.size, Math.round(SUITED_HEIGHT * this.ratio));
            if (this.canvas.width !== picture.width || this.canvas.height !== picture.height)
                Object.assign(this.canvas, {width: picture.width, height: picture.height});
            this.canvas.getContext("2d", {alpha: false}).putImageData(picture, 0, 0);
            this.canvas.dataset.tick = this.engine.tick;
            this.canvas.setAttribute("aria-label", `The picture of tick ${this.engine.tick}`);
            this.seen = this.engine.camera();
            if (!this.isShown) {
                this.appears();
                this.stage.replaceChildren(this.canvas, this.marks);
            }
            if (!this.exact && this.rows !== this.engine.rows)
                this.showRows(JSON.parse(this.rows = this.engine.rows));
            this.mark();
            this.adapt(performance.now() - start);
        } catch (error) {
            this.showStatus(error.message);
        }
    }

    /* Choose the scale of a moving view by the ms that the last pictures took. One slow picture alone changes nothing,
     * because the first picture of a new size is slow: it needs new memory. */
    adapt(cost)
    {
        const least = Math.min(cost, this.coarseCost ?? 0);
        this.coarseCost = this.scale < 1 ? cost : undefined;
        if (this.scale === 1)
            this.cost = cost;
        else if (least > SLOW)
            this.coarse = Math.max(this.coarse * COARSER, COARSEST);
        else if (cost < SLOW / 3)
            this.coarse = Math.min(this.coarse / COARSER, COARSE);
    }

    /* Change the view while it moves. A slow picture loses pixels until the view rests. */
    glide(changes)
    {
        if (!this.exact && this.cost > SMOOTH)
            this.scale = this.coarse;
        clearTimeout(this.resting);
        this.resting = setTimeout(() => {
            const isCoarse = this.scale < 1;
            this.scale = 1;
            if (isCoarse)
                this.draw();
        }, REST);
        return this.look(changes);
    }

    /* Change the view. If the module refuses the new values, the view stays unchanged. */
    look(changes)
    {
        const view = {...this.view, ...changes};
        for (const [name, value] of Object.entries(view))
            if (value === undefined)
                delete view[name];
        try {
            this.engine.look(view);
            this.showStatus("");
        } catch (error) {
            this.showStatus(error.message.replace(/^the view:\d+: /, ""));
        }
        this.changed();
        return this.engine.lacksSums ? this.again() : this.draw();
    }

    lookAsRecorded()
    {
        this.engine.look(this.recorded);
        this.changed();
        return this.draw();
    }

    /* ---- Turning, moving, zooming ----------------------------------------------------------------------------- */

    direction()
    {
        const {right, forward} = this.camera, turn = 180 / Math.PI;
        return [Math.atan2(right[1], right[0]) * turn, Math.asin(clamp(-forward[2], -1, 1)) * turn];
    }

    turn(dx, dy)
    {
        const [azimuth, elevation] = this.direction();
        const turned = ((azimuth - dx * DEGREES_A_PIXEL) % 360 + 540) % 360 - 180;
        return this.glide({look: [rounded(turned), rounded(clamp(elevation + dy * DEGREES_A_PIXEL, -90, 90))]});
    }

    /* The camera of the view at a pixel: inside the close-up it is the camera of the close-up. */
    cameraAt([x, y])
    {
        const {closeup} = this.camera, [left, top, width, height] = closeup?.window ?? [0, 0, 0, 0];
        return x >= left && y >= top && x < left + width && y < top + height ? {...this.camera, ...closeup} : this.camera;
    }

    /* The center of a camera after the picture has been moved by a number of pixels, rounded to about a hundredth of a
     * pixel, so that addresses stay short. */
    moved(dx, dy, {right, up, center, pixel} = this.camera)
    {
        const decimals = clamp(Math.ceil(2 - Math.log10(pixel)) || 0, 0, 100);
        return center.map((at, i) => roundedPlace(Number((at - (right[i] * dx - up[i] * dy) * pixel).toFixed(decimals))));
    }

    move(dx, dy)
    {
        return this.glide({center: this.moved(dx, dy)});
    }

    /* Zoom by a factor. The position at the pixel (x, y) stays at that pixel. */
    zoom(factor, x, y)
    {
        const before = this.view.zoom ?? 1, after = clamp(before * factor, ...ZOOMS);
        const {middle} = this.camera, away = after / before - 1;
        const center = this.moved((middle[0] - x) * away / (1 + away), (middle[1] - y) * away / (1 + away));
        return this.glide({zoom: rounded(after), center});
    }

    /* ---- The pointer -------------------------------------------------------------------------------------------- */

    /* The pixel of the picture at a pointer's position, and the CSS pixels for each pixel of the picture. */
    pixelAt(event)
    {
        const box = (this.stage.firstElementChild ?? this.stage).getBoundingClientRect();
        const scale = box.width / (this.isShown ? this.canvas.width : this.size[0]) || 1;
        return [(event.clientX - box.left) / scale, (event.clientY - box.top) / scale, scale];
    }

    down(event)
    {
        this.stage.setPointerCapture?.(event.pointerId);
        this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY, far: 0});
    }

    /* Change the view by dragging. One pointer turns the camera; with Shift or a secondary button, it moves the
     * picture. Two pointers move and zoom the picture. */
    drag(event)
    {
        const pointer = this.pointers.get(event.pointerId);
        if (!pointer)
            return;
        const [x, y, scale] = this.pixelAt(event);
        const dx = event.clientX - pointer.x, dy = event.clientY - pointer.y;
        pointer.far += Math.hypot(dx, dy);
        if (pointer.far < CLICK)
            return;
        const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
        if (other) {
            const [from, to] = [pointer, {x: event.clientX, y: event.clientY}].map(
                at => Math.hypot(at.x - other.x, at.y - other.y));
            this.move(dx / 2 / scale, dy / 2 / scale);
            this.drawNow();
            if (from > 0)
                this.zoom(to / from, x, y);
        } else if (event.shiftKey || event.buttons & ~1) {
            this.move(dx / scale, dy / scale);
        } else {
            this.turn(dx, dy);
        }
        pointer.x = event.clientX;
        pointer.y = event.clientY;
        this.drawNow();
    }

    up(event)
    {
        const pointer = this.pointers.get(event.pointerId);
        this.pointers.delete(event.pointerId);
        return pointer !== undefined && pointer.far < CLICK && event.type === "pointerup" && event.button === 0;
    }

    wheel(event)
    {
        const at = this.pixelAt(event), [x, y] = this.cameraAt(at) === this.camera ? at : this.camera.middle;
        this.zoom(ZOOM_A_NOTCH ** -(event.deltaY * (event.deltaMode ? 30 : 1)), x, y);
        this.drawNow();
    }

    /* ---- Identifying ------------------------------------------------------------------------------------------ */

    /* Identify the elements at the position of a pointer event. Without an event, the middle of the view is used. */
    pickAt(event)
    {
        const at = event && this.pixelAt(event);
        if (!this.isShown || `${this.engine.size}` !== `${[this.canvas.width, this.canvas.height]}`)
            this.drawNow();
        const [x, y] = (at ?? this.camera.middle).map(Math.floor), {width, height} = this.canvas;
        if (x < 0 || y < 0 || x >= width || y >= height)
            return;
        const pick = this.engine.pick(x, y, Math.round(PICK_RADIUS * this.ratio));
        this.subject = ["point", "node", "foreign_node", "query"].map(kind => pick.elements.find(found => found[kind]))
            .find(found => found) ?? null;
        const thickness = rounded(this.cameraAt([x, y]).pixel * PICK_RADIUS * this.ratio);
        this.picked(pick, this.placeOfSubject() ?? this.placeAt([x, y]), {...this.engine.ray(x + 0.5, y + 0.5), thickness});
        this.mark();
    }

    /* Turn the camera by one step, for a key. */
    turnStep(dx, dy)
    {
        return this.turn(dx * KEY_STEP, dy * KEY_STEP);
    }

    zoomStep(factor)
    {
        return this.zoom(factor, ...this.camera.middle);
    }

    get boxOfSubject()
    {
        return (this.subject?.node ?? this.subject?.foreign_node)?.box;
    }

    /* The position of the marked element. For a node this is the center of its box. Null if no element is marked. */
    placeOfSubject()
    {
        if (this.subject?.point)
            return this.engine.point(this.subject.point.id) ?? this.subject.point.position;
        const box = this.boxOfSubject;
        return box ? box.min.map((low, i) => (low + box.max[i]) / 2) : null;
    }

    /* The position in the world at a pixel, at the distance of the camera's center from the camera. */
    placeAt([x, y])
    {
        const camera = this.cameraAt([x, y]), {middle} = camera;
        return this.moved(middle[0] - x, middle[1] - y, camera);
    }

    /* Mark the picked element in the picture, at its position in this tick. */
    mark()
    {
        const {width, height} = this.canvas, point = this.subject?.point && this.engine.point(this.subject.point.id);
        const wasMarked = this.isMarked;
        this.isMarked = this.subject !== null || this.measured.length > 0;
        if (!wasMarked && !this.isMarked)
            return; /* clearing an empty canvas would take time at each picture */
        Object.assign(this.marks, {width, height});
        const context = this.marks.getContext("2d");
        context.strokeStyle = MARK_COLOR;
        context.lineWidth = 2 * this.ratio;
        context.beginPath();
        if (point)
            this.tracePoint(context, point);
        else if (this.boxOfSubject)
            this.traceBox(context, this.boxOfSubject);
        traceMeasure(context, this.engine.project(this.measured), this.measured, this.ratio);
        context.stroke();
    }

    tracePoint(context, place)
    {
        const [[x, y]] = this.engine.project([place]);
        if (!isNaN(x))
            context.arc(x, y, MARK_RADIUS * this.ratio, 0, 2 * Math.PI);
    }

    traceBox(context, {min, max})
    {
        const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(i => [0, 1, 2].map(axis => (i >> axis & 1 ? max : min)[axis]));
        const seen = this.engine.project(corners);
        for (const [from, to] of BOX_EDGES) {
            if (isNaN(seen[from][0]) || isNaN(seen[to][0]))
                continue;
            context.moveTo(...seen[from]);
            context.lineTo(...seen[to]);
        }
    }
}
