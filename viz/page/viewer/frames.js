/* SPDX-License-Identifier: MIT */
/* frames.js - the recorded PNG frames. A frame is decoded before it is shown, and the last few decoded frames are
 * kept. */
"use strict";

const FRAMES_KEPT = 12;

class Frames {
    /* `nameOf(tick)` returns the file name of the frame of a tick. */
    constructor(stage, nameOf)
    {
        this.stage = stage;
        this.nameOf = nameOf;
        this.decoded = new Map(); /* maps a tick to the promise of an image; the least recently used first */
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

    /* Show the frame of a tick. Only one frame loads at a time. If several ticks are requested during this time, only
     * the last of them is shown. */
    async show(tick)
    {
        this.wanted = tick;
        if (this.busy)
            return;
        this.busy = true;
        while (this.shown !== this.wanted) {
            const next = this.wanted, parts = next < 0 ? [] : [await this.load(next)];
            if (this.wanted === null)
                break;
            this.stage.replaceChildren(...parts);
            this.shown = next;
        }
        this.busy = false;
    }

    /* Leave the stage to other pictures. A frame that is still being decoded is not shown. */
    leave()
    {
        this.wanted = this.shown = null;
    }

    /* Start to decode the frames of ticks that are likely to be shown next. */
    prepare(ticks)
    {
        ticks.forEach(tick => this.load(tick));
    }
}
