/* SPDX-License-Identifier: MIT */
/* timeline.js - the timeline: one lane for each event and each curve. All lanes have the same scale of ticks and mark
 * the current tick. */
"use strict";

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

/* Converts between ticks and horizontal positions in a lane. */
class Scale {
    constructor(ticks, width)
    {
        this.last = ticks - 1;
        this.width = width - 2 * THUMB;
    }

    x(tick)
    {
        return THUMB + (this.last > 0 ? tick / this.last * this.width : 0);
    }

    tick(x)
    {
        const tick = Math.round((x - THUMB) / this.width * this.last);
        return Math.min(Math.max(tick || 0, 0), this.last);
    }
}

/* Draw the ticks with an event. Consecutive ticks with the event become one bar, so that a lane of any length needs few
 * rectangles. */
function drawEvents(context, scale, height, events, bit)
{
    const half = Math.max(Math.min(scale.width / Math.max(scale.last, 1) * 0.4, 5), 0.75);
    for (let i = 0; i < events.length; i++) {
        if (!(events[i] & bit))
            continue;
        const first = i;
        while (i + 1 < events.length && events[i + 1] & bit)
            i++;
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
    const ticksAPixel = 1 / (scale.x(1) - scale.x(0));
    let gap = true;
    for (let i = 0; i < values.length;) {
        const from = i, x = scale.x(i);
        do
            i++;
        while (i + 1 < from + ticksAPixel && i < values.length && !isNaN(values[from]) && !isNaN(values[i]));
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
    /* `goTo(tick)` shows a tick. `toggle(bit)` selects or deselects an event. */
    constructor(recording, {goTo, toggle})
    {
        this.root = document.getElementById("timeline");
        this.scrub = document.getElementById("scrub");
        this.cursor = document.getElementById("cursor");
        this.tick = this.bits = 0;
        this.lanes = [];
        this.toggle = toggle;
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
        this.recording = recording;
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
        this.draw();
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

    followPointer(goTo)
    {
        const follow = event => goTo(this.scale.tick(event.clientX - this.scrub.getBoundingClientRect().left));
        this.scrub.addEventListener("pointerdown", event => {
            if (event.button !== 0)
                return;
            this.scrub.setPointerCapture?.(event.pointerId);
            follow(event);
        });
        this.scrub.addEventListener("pointermove", event => event.buttons & 1 && follow(event));
    }

    measure()
    {
        this.width = this.scrub.clientWidth;
        this.scale = new Scale(this.recording.length, this.width);
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
        this.tick = tick;
        this.cursor.style.transform = `translateX(${this.scale.x(tick)}px)`;
        for (const lane of this.lanes)
            lane.shown.textContent = lane.value(tick);
    }

    /* Fade the lanes of all events that are not selected. */
    choose(bits)
    {
        this.bits = bits;
        for (const {bit, label, canvas} of this.lanes) {
            if (!bit)
                continue;
            label.setAttribute("aria-pressed", String((bits & bit) !== 0));
            canvas.classList.toggle("faded", bits !== 0 && !(bits & bit));
        }
    }
}
