/* SPDX-License-Identifier: MIT */
/* timeline.js - the timeline: one lane for each event and each curve. All lanes have the same scale of ticks and mark
 * the current tick. */
"use strict";

const FEWEST_TICKS = 10; /* the lanes zoom in until they show only this many ticks */

/* Half the width of the slider's thumb in CSS pixels; the lanes are inset by it, so that they line up with the
 * slider. */
const THUMB = 8;

function colorOf(name)
{
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
}

/* Clear a canvas and give it the resolution of the screen. Coordinates of the returned context are CSS pixels. */
function prepareCanvas(canvas)
{
    const ratio = window.devicePixelRatio, context = canvas.getContext("2d");
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    context.scale(ratio, ratio);
    return context;
}

/* Converts between ticks and horizontal positions in a lane, which shows the ticks `from` to `to`. */
class Scale {
    constructor(ticks, width, from = 0, to = ticks - 1)
    {
        Object.assign(this, {last: ticks - 1, width: width - 2 * THUMB, from, to});
    }

    x(tick)
    {
        return THUMB + (this.to > this.from ? (tick - this.from) / (this.to - this.from) * this.width : 0);
    }

    /* The tick at a horizontal position, as a number with a fraction. */
    place(x)
    {
        return this.from + clamp((x - THUMB) / this.width || 0, 0, 1) * (this.to - this.from);
    }

    tick(x)
    {
        return clamp(Math.round(this.place(x)), 0, this.last);
    }

    /* The first tick in sight, and the first one after those in sight. A tick beyond each end is included. */
    get ends()
    {
        return [Math.max(Math.floor(this.from), 0), Math.min(Math.ceil(this.to), this.last) + 1];
    }

    get pixelsATick()
    {
        return this.width / Math.max(this.to - this.from, 1);
    }
}

/* Draw the ticks with an event. Ticks with the event that are closer than a pixel become one bar, so that a lane of any
 * length needs few rectangles. */
function drawEvents(context, scale, height, events, bit)
{
    const half = clamp(scale.pixelsATick * 0.4, 0.75, 5), gap = Math.max(Math.floor(1 / scale.pixelsATick), 1);
    const [begin, end] = scale.ends;
    for (let i = begin; i < end; i++) {
        if (!(events[i] & bit))
            continue;
        const first = i;
        for (let next = i + 1; next < end && next - i <= gap; next++)
            if (events[next] & bit)
                i = next;
        context.fillRect(scale.x(first) - half, 2, scale.x(i) - scale.x(first) + 2 * half, height - 4);
    }
}

function rangeOf(values)
{
    let low = Infinity, high = -Infinity;
    for (const value of values) {
        low = value < low ? value : low; /* a comparison with NaN is false, so NaN is skipped */
        high = value > high ? value : high;
    }
    return [low, high];
}

/* Trace a curve as steps, not slopes, because there is nothing between two ticks. A tick without a value leaves a gap.
 * If several ticks share a pixel, the first, lowest, highest and last of their values are drawn. */
function traceCurve(context, scale, y, values)
{
    const ticksAPixel = 1 / scale.pixelsATick, [begin, end] = scale.ends;
    let gap = true;
    for (let i = begin; i < end;) {
        const from = i, x = scale.x(i);
        do
            i++;
        while (i + 1 < from + ticksAPixel && i < end && !isNaN(values[from]) && !isNaN(values[i]));
        const part = values.slice(from, i);
        if (!gap && !isNaN(part[0]))
            context.lineTo(x, y(values[from - 1]));
        else
            context.moveTo(x, y(part[0]));
        gap = isNaN(part[0]);
        for (const value of gap ? [] : [part[0], ...rangeOf(part), part.at(-1)])
            context.lineTo(x, y(value));
    }
}

function drawCurve(context, scale, height, values, [low, high])
{
    const room = height - 10;
    const y = value => high > low ? 5 + room * (high - value) / (high - low) : height / 2;
    context.beginPath();
    traceCurve(context, scale, y, values);
    context.lineWidth = 1.5;
    context.lineJoin = "round";
    context.stroke();
}

class Timeline {
    /* `goTo(tick)` shows a tick. `toggle(bit)` selects or deselects an event. The lanes show the ticks `from` to `to`;
     * the numbers may have fractions. The lanes are drawn after the browser has shown the first picture, because the
     * lanes of 10,000 ticks would delay it: `begun` is the promise of this picture. */
    constructor(recording, begun, {goTo, toggle})
    {
        this.begun = begun;
        this.root = document.getElementById("timeline");
        this.scrub = document.getElementById("scrub");
        this.cursor = document.getElementById("cursor");
        this.tick = this.bits = this.from = this.to = 0;
        this.lanes = [];
        this.toggle = toggle;
        this.part = element("div");
        this.range = element("div", this.part, {id: "range", title: "The ticks that the lanes show"});
        this.root.append(this.range);
        this.list = new EventList(byId("events"), goTo);
        this.show(recording);
        this.followPointer(goTo);
        /* Measure now, and later only after a resize: measuring at each tick would cost a layout of the page. */
        this.measure();
        new ResizeObserver(() => this.scrub.clientWidth !== this.width && this.draw()).observe(this.root);
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    }

    /* Show another recording, or the same recording after ticks were added to it. */
    show(recording)
    {
        if (!this.isZoomed)
            this.to = recording.length - 1;
        this.recording = recording;
        this.limit(this.from, this.to);
        this.list.show(recording, this.bits);
        this.root.classList.toggle("two-trees", recording.hasForeignNodes);
        for (const lane of this.lanes)
            for (const part of [lane.label, lane.canvas, lane.shown])
                part.remove();
        const shown = ([, , of], i) => of !== "rare" || recording.count(1 << i);
        this.lanes = [...EVENTS.flatMap((event, i) => shown(event, i) ? [this.eventLane(event, 1 << i)] : []),
                      ...recording.curves.map(curve => this.curveLane(curve))];
        this.lanes.forEach((lane, i) => this.place(lane, i + 2));
        this.scrub.style.gridRow = `2 / span ${this.lanes.length}`;
        this.choose(this.bits);
        this.measure();
        this.mark(this.tick);
        this.begun.then(() => requestAnimationFrame(() => setTimeout(() => this.draw())));
    }

    eventLane([name, sign, of], bit)
    {
        const count = this.recording.count(bit);
        const words = this.recording.nameOf(name, of);
        const label = element("button", words, {type: "button", class: "lane-label", "data-event": name,
                                               "aria-pressed": "false", title: `Select ticks with the event ${words}`});
        label.prepend(element("span", sign, {class: "sign", "aria-hidden": "true"}));
        label.disabled = count === 0;
        label.addEventListener("click", () => this.toggle(bit));
        const paint = (context, scale, height) => drawEvents(context, scale, height, this.recording.events, bit);
        return {name, bit, label, paint, value: () => grouped(count), kind: "event"};
    }

    curveLane({name, of, values})
    {
        const range = rangeOf(values), [low, high] = range;
        const label = element("span", this.recording.nameOf(name, of), {class: "lane-label"});
        if (low < high)
            label.append(element("small", `${grouped(low)}–${grouped(high)}`));
        const paint = (context, scale, height) => drawCurve(context, scale, height, values, range);
        const value = tick => isNaN(values[tick]) ? ABSENT : grouped(values[tick]);
        return {name, bit: 0, label, paint, value, kind: low < high ? "curve" : "curve constant"};
    }

    place(lane, row)
    {
        lane.canvas = element("canvas", "", {class: `lane ${lane.kind}`, "aria-hidden": "true"});
        lane.shown = element("output", "", {class: "lane-value", "data-lane": lane.name});
        for (const part of [lane.label, lane.canvas, lane.shown]) {
            part.style.gridRow = row;
            this.root.append(part);
        }
    }

    /* ---- The part in sight ---- */

    get isZoomed()
    {
        return this.recording && this.to - this.from < this.recording.length - 1;
    }

    /* Set the ticks that the lanes show, within those of the recording. */
    limit(from, to)
    {
        const last = this.recording.length - 1, span = clamp(to - from, Math.min(last, FEWEST_TICKS), last);
        this.from = clamp((from + to - span) / 2, 0, last - span);
        this.to = this.from + span;
    }

    look(from, to)
    {
        this.limit(from, to);
        this.drawing ??= requestAnimationFrame(() => {
            this.drawing = undefined;
            this.draw();
        });
    }

    /* Zoom by a factor; the place `at`, in ticks, stays where it is. */
    zoom(factor, at = this.tick)
    {
        const place = clamp(at, this.from, this.to), scale = 1 / clamp(factor, 1e-6, 1e6);
        this.look(place - (place - this.from) * scale, place + (this.to - place) * scale);
    }

    /* ---- The pointer ---- */

    followPointer(goTo)
    {
        const held = new Map(); /* the pointers that are down, with their horizontal positions */
        const xOf = event => event.clientX - this.scrub.getBoundingClientRect().left;
        const spread = () => Math.abs([...held.values()].reduce((a, b) => a - b));
        const listen = (types, act) => types.forEach(type => this.scrub.addEventListener(type, act));
        listen(["pointerdown"], event => {
            if (event.button !== 0)
                return;
            this.scrub.setPointerCapture?.(event.pointerId);
            held.set(event.pointerId, xOf(event));
            if (held.size === 1)
                goTo(this.scale.tick(xOf(event)));
        });
        listen(["pointermove"], event => {
            const x = xOf(event), before = held.size === 2 ? spread() : 0;
            if (held.has(event.pointerId))
                held.set(event.pointerId, x);
            if (before && held.has(event.pointerId))
                this.zoom(Math.max(spread(), 1) / before, this.scale.place(x));
            else if (event.buttons & 1)
                goTo(this.scale.tick(x));
        });
        listen(["pointerup", "pointercancel"], event => held.delete(event.pointerId));
        this.scrub.addEventListener("wheel", event => {
            event.preventDefault();
            const {deltaX, deltaY, deltaMode, shiftKey} = event, unit = deltaMode ? 30 : 1;
            const along = (shiftKey ? deltaX || deltaY : Math.abs(deltaX) > Math.abs(deltaY) ? deltaX : 0) * unit;
            if (along)
                this.look(this.from + along / this.scale.pixelsATick, this.to + along / this.scale.pixelsATick);
            else
                this.zoom(ZOOM_A_NOTCH ** -(deltaY * unit), this.scale.place(xOf(event)));
        }, {passive: false});
        /* Dragging in the range bar moves the part in sight. */
        const moveRange = event => {
            const middle = this.whole.place(event.offsetX), half = (this.to - this.from) / 2;
            this.look(middle - half, middle + half);
        };
        this.range.addEventListener("pointerdown", event => {
            this.range.setPointerCapture?.(event.pointerId);
            moveRange(event);
        });
        this.range.addEventListener("pointermove", event => event.buttons & 1 && moveRange(event));
    }

    measure()
    {
        this.width = this.scrub.clientWidth;
        this.scale = new Scale(this.recording.length, this.width, this.from, this.to);
        this.whole = new Scale(this.recording.length, this.width); /* the scale of the slider and the range bar */
        const [left, right] = [this.from, this.to].map(at => this.whole.x(at));
        this.range.hidden = !this.isZoomed;
        Object.assign(this.part.style, {marginLeft: `${left}px`, width: `${Math.max(right - left, 4)}px`});
    }

    draw()
    {
        this.measure();
        for (const {name, bit, canvas, paint} of this.lanes) {
            const context = prepareCanvas(canvas);
            context.fillStyle = context.strokeStyle = colorOf(bit ? name : "curve");
            paint(context, this.scale, canvas.clientHeight);
        }
        this.mark(this.tick);
    }

    mark(tick)
    {
        const {from, to} = this, before = (to - from) * (tick > to ? 0.1 : 0.9);
        if (tick !== this.tick && (tick < from || tick > to)) /* show the ticks to which playing goes on */
            this.look(tick - before, tick - before + to - from);
        this.tick = tick;
        this.cursor.hidden = tick < this.scale.from || tick > this.scale.to;
        this.cursor.style.transform = `translateX(${this.scale.x(tick)}px)`;
        this.list.mark(tick);
        for (const lane of this.lanes)
            lane.shown.textContent = lane.value(tick);
    }

    /* Fade the lanes of all events that are not selected. */
    choose(bits)
    {
        if (bits !== this.bits)
            this.list.show(this.recording, bits);
        this.bits = bits;
        for (const {bit, label, canvas} of this.lanes) {
            if (!bit)
                continue;
            label.setAttribute("aria-pressed", String((bits & bit) !== 0));
            canvas.classList.toggle("faded", bits !== 0 && !(bits & bit));
        }
    }
}
