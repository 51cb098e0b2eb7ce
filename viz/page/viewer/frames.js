/* SPDX-License-Identifier: MIT */
/* frames.js - the recorded PNG frames: each is decoded before it is shown, and the last few are kept. */
"use strict";

const FRAMES_KEPT = 12;

class Frames {
    /* `nameOf(tick)` returns the file name of a tick's frame. */
    constructor(stage, nameOf)
    {
        this.stage = stage;
        this.nameOf = nameOf;
        this.decoded = new Map(); /* tick -> promise of an image; the least recently used first */
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
            return this.describeMissing(tick);
        }
    }

    describeMissing(tick)
    {
        const text = document.createElement("p");
        text.textContent = `${this.nameOf(tick)} is missing beside this page or cannot be read.`;
        return text;
    }

    /* Show a tick's frame. One frame loads at a time; if the slider moves on meanwhile, only the last tick follows. */
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

    /* Start to decode frames that are likely to be shown next. */
    prepare(ticks)
    {
        ticks.forEach(tick => this.load(tick));
    }
}
