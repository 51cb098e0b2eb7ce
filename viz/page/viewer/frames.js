/* SPDX-License-Identifier: MIT */
/* frames.js - the pictures: decoded before they are shown, and only a few of them kept. */
"use strict";

const FRAMES_KEPT = 12;

class Frames {
    /* `nameOf` gives the file of a tick that was filmed. */
    constructor(stage, nameOf)
    {
        this.stage = stage;
        this.nameOf = nameOf;
        this.decoded = new Map(); /* tick -> promise of an image; the least recently wanted first */
        this.shown = this.wanted = -1;
        this.busy = false;
    }

    load(tick)
    {
        const image = this.decoded.get(tick) ?? this.decode(tick);
        this.decoded.delete(tick);
        this.decoded.set(tick, image);
        if (this.decoded.size > FRAMES_KEPT)
            this.decoded.delete(this.decoded.keys().next().value);
        return image;
    }

    async decode(tick)
    {
        const image = new Image();
        image.src = this.nameOf(tick);
        image.alt = `The frame of tick ${tick}`;
        image.dataset.tick = tick;
        try {
            await image.decode();
            return image;
        } catch {
            return this.excuse(tick);
        }
    }

    excuse(tick)
    {
        const text = document.createElement("p");
        text.textContent = `${this.nameOf(tick)} is not beside this page, or cannot be read.`;
        return text;
    }

    /* However fast the slider is dragged, one picture is under way at a time, and the one wanted last is next. */
    async show(tick)
    {
        this.wanted = tick;
        if (this.busy)
            return;
        this.busy = true;
        while (this.shown !== this.wanted) {
            const next = this.wanted;
            this.stage.replaceChildren(...(next < 0 ? [] : [await this.load(next)]));
            this.shown = next;
        }
        this.busy = false;
    }

    /* Begin to decode what will be wanted soon. */
    prepare(ticks)
    {
        ticks.forEach(tick => this.load(tick));
    }
}
