/* SPDX-License-Identifier: MIT */
/* stage.js - the pictures of one frame, in panes. The panes lie on top of each other or side by side, and all show the
 * same part of their pictures. */
"use strict";

const PICTURES = ["expected", "actual", "difference", "flip"];
const LARGEST_SCALE = 64;
/* The width of the shown part, in pixels of the picture, when a pane is zoomed to the worst pixel. */
const WORST_ACROSS = 48;
const BLINK = 600; /* ms between two pictures of the blink mode */
const EDGE = 8; /* CSS pixels by which a mark is larger than the pixels that it marks */

const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

/* The panes that each mode shows. If panes overlap, the last one is on top. */
const PANES = {
    swipe: ["expected", "actual"],
    blink: ["expected", "actual"],
    difference: ["difference"],
    flip: ["flip"],
    side: ["expected", "actual", "difference"],
    expected: ["expected"],
    actual: ["actual"],
};

class Stage {
    constructor(root)
    {
        this.root = root;
        this.handle = document.getElementById("handle");
        this.panes = new Map(PICTURES.map(name => [name, root.querySelector(`[data-picture="${name}"]`)]));
        this.images = new Map();
        this.mode = "swipe";
        this.swiped = 50; /* percent of the stage that shows the expected picture */
        /* {scale, x, y}: the pixel (x, y) of the picture is in the middle; null: the whole picture is shown. */
        this.zoom = null;
        this.marked = true;
        this.still = matchMedia("(prefers-reduced-motion: reduce)").matches;
        this.onchange = () => {};
        new ResizeObserver(() => this.arrange()).observe(root);
        this.listen();
    }

    /* ---- Pictures -------------------------------------------------------------------------------------- */

    /* Show the pictures of a frame. `addresses` holds a data URL for each picture. `place` holds the worst pixel and
     * the box around all differences. */
    async show(addresses, place)
    {
        const wanted = this.wanted = {};
        const images = new Map(await Promise.all(Object.entries(addresses).map(async ([name, address]) =>
            [name, await this.load(name, address)])));
        if (this.wanted !== wanted)
            return; /* another frame was requested during the loading */
        this.images = images;
        this.place = place;
        this.zoom = null;
        this.width = Math.max(1, ...[...images.values()].map(image => image.naturalWidth));
        this.height = Math.max(1, ...[...images.values()].map(image => image.naturalHeight));
        for (const [name, pane] of this.panes) {
            const label = pane.querySelector(".label");
            label.textContent = name;
            pane.replaceChildren(...(images.has(name) ? [images.get(name)] : []), label, ...this.marks());
        }
        this.look(this.mode);
    }

    load(name, address)
    {
        const image = new Image();
        image.alt = name;
        image.draggable = false;
        image.decoding = "sync"; /* decode the image before it is shown, so that the pane is never empty */
        return new Promise(done => {
            image.onload = image.onerror = () => done(image); /* a picture that cannot be decoded stays empty */
            image.src = address;
        });
    }

    marks()
    {
        return this.place ? ["box", "ring"].map(name => {
            const mark = document.createElement("div");
            mark.className = `mark ${name}`;
            return mark;
        }) : [];
    }

    can(mode)
    {
        return PANES[mode].every(name => this.images.has(name));
    }

    /* ---- Modes --------------------------------------------------------------------------------------- */

    /* Show the pictures in a mode. If the frame lacks a picture for this mode, another picture is shown instead; the
     * mode stays for the next frame. */
    look(mode)
    {
        this.mode = mode;
        this.seen = this.can(mode) ? mode : PICTURES.find(name => this.can(name)) ?? "";
        this.root.dataset.mode = this.seen;
        clearInterval(this.blinking);
        if (this.seen === "blink" && !this.still)
            this.blinking = setInterval(() => this.flip(), BLINK);
        this.root.classList.remove("flipped");
        this.zoom &&= {...this.zoom, scale: Math.max(this.zoom.scale, this.fit())};
        this.arrange();
    }

    flip()
    {
        this.root.classList.toggle("flipped");
    }

    /* Switch between the pictures by hand. This ends the automatic blinking. */
    flipByHand()
    {
        if (this.seen !== "blink")
            this.look("blink");
        clearInterval(this.blinking);
        this.flip();
    }

    swipe(percent)
    {
        this.swiped = clamp(percent, 0, 100);
        this.handle.setAttribute("aria-valuenow", Math.round(this.swiped));
        this.root.style.setProperty("--swiped", `${this.swiped}%`);
    }

    /* ---- Zoom ----------------------------------------------------------------------------------------------- */

    shown()
    {
        return this.seen ? PANES[this.seen].map(name => this.panes.get(name)) : [];
    }

    /* The number of columns for which the panes are largest. */
    columns()
    {
        if (this.seen !== "side")
            return 1;
        const size = columns => Math.min(this.root.clientWidth / columns / this.width,
                                         this.root.clientHeight / Math.ceil(3 / columns) / this.height);
        return [3, 2, 1].reduce((best, columns) => size(columns) > size(best) ? columns : best);
    }

    fit()
    {
        const pane = this.shown()[0];
        const scale = Math.min(pane.clientWidth / this.width, pane.clientHeight / this.height);
        return scale > 1 ? Math.floor(scale) : scale; /* enlarge small pictures only by whole factors */
    }

    scale()
    {
        return this.zoom?.scale ?? this.fit();
    }

    middle()
    {
        return this.zoom ?? {x: this.width / 2, y: this.height / 2};
    }

    zoomTo(scale, x, y)
    {
        const least = this.fit();
        this.zoom = scale <= least ? null :
            {scale: Math.min(scale, LARGEST_SCALE), x: clamp(x, 0, this.width), y: clamp(y, 0, this.height)};
        this.arrange();
    }

    zoomBy(factor)
    {
        const {x, y} = this.middle();
        this.zoomTo(this.scale() * factor, x, y);
    }

    /* Zoom to the worst pixel. If the stage is already zoomed to it, show the whole picture again. */
    zoomToWorst()
    {
        if (!this.place || this.zoom?.worst) {
            this.zoomTo(0);
            return;
        }
        const [x, y] = this.place.worst, pane = this.shown()[0];
        this.zoomTo(Math.max(2 * this.fit(), Math.round(pane.clientWidth / WORST_ACROSS), 4), x + 0.5, y + 0.5);
        if (this.zoom)
            this.zoom.worst = true;
    }

    /* ---- Layout ----------------------------------------------------------------------------------- */

    arrange()
    {
        if (!this.seen)
            return;
        this.root.style.setProperty("--columns", this.columns());
        this.root.classList.toggle("zoomed", this.zoom !== null);
        const scale = this.scale(), {x, y} = this.middle();
        for (const pane of this.shown()) {
            const left = pane.clientWidth / 2 - x * scale, top = pane.clientHeight / 2 - y * scale;
            const image = pane.querySelector("img");
            image.style.transform = `translate(${left}px, ${top}px) scale(${scale})`;
            image.style.imageRendering = scale >= 2 ? "pixelated" : "auto";
            this.putMarks(pane, left, top, scale);
        }
        this.swipe(this.swiped);
        this.onchange();
    }

    putMarks(pane, left, top, scale)
    {
        if (!this.place)
            return;
        const {worst, min, max} = this.place;
        const put = (mark, [x0, y0], [x1, y1], least) => {
            const width = Math.max((x1 + 1 - x0) * scale + EDGE, least), height = Math.max((y1 + 1 - y0) * scale + EDGE, least);
            mark.style.width = `${width}px`;
            mark.style.height = `${height}px`;
            mark.style.transform = `translate(${left + (x0 + x1 + 1) / 2 * scale - width / 2}px, ${
                                              top + (y0 + y1 + 1) / 2 * scale - height / 2}px)`;
        };
        put(pane.querySelector(".box"), min, max, 0);
        put(pane.querySelector(".ring"), worst, worst, 26);
        this.root.classList.toggle("unmarked", !this.marked);
    }

    toggleMarks()
    {
        this.marked = !this.marked;
        this.arrange();
    }

    /* ---- Pointer -------------------------------------------------------------------------------------------- */

    listen()
    {
        this.root.addEventListener("wheel", event => this.wheel(event), {passive: false});
        this.root.addEventListener("pointerdown", event => this.grab(event));
        this.root.addEventListener("pointermove", event => this.drag(event));
        for (const end of ["pointerup", "pointercancel"])
            this.root.addEventListener(end, () => this.held = null);
    }

    /* Zoom with the wheel. The pixel under the pointer stays under the pointer. */
    wheel(event)
    {
        const pane = event.target.closest(".pane");
        if (!pane || !this.seen)
            return;
        event.preventDefault();
        const box = pane.getBoundingClientRect(), before = this.scale(), {x, y} = this.middle();
        const right = event.clientX - box.left - box.width / 2, down = event.clientY - box.top - box.height / 2;
        const after = clamp(before * 2 ** (-event.deltaY / 300), this.fit(), LARGEST_SCALE);
        this.zoomTo(after, x + right / before - right / after, y + down / before - down / after);
    }

    grab(event)
    {
        if (event.button !== 0 || !this.seen)
            return;
        const swipes = this.seen === "swipe" && (!this.zoom || event.target === this.handle);
        this.held = {swipes, x: event.clientX, y: event.clientY, from: this.middle()};
        this.root.setPointerCapture(event.pointerId);
        this.drag(event);
    }

    drag(event)
    {
        if (!this.held)
            return;
        const box = this.root.getBoundingClientRect(), {x, y} = this.held.from, scale = this.scale();
        if (this.held.swipes)
            this.swipe(100 * (event.clientX - box.left) / box.width);
        else if (this.zoom)
            this.zoomTo(scale, x - (event.clientX - this.held.x) / scale, y - (event.clientY - this.held.y) / scale);
    }
}
