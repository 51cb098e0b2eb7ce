/* SPDX-License-Identifier: MIT */
/* curve.js - a chart with one bar for each compared frame: the number of pixels that differ. A click on a bar goes to
 * its frame. */
"use strict";

const BAR_GAP = 3; /* CSS pixels per bar: if there are fewer, the bars touch each other */

/* The height of a bar as a fraction of the chart's height. With the square root, a bar of a hundredth of the largest
 * count is still visible. */
function barHeight(pixels, most)
{
    return most > 0 ? Math.sqrt(pixels / most) : 0;
}

class Curve {
    constructor(section, findings, goTo)
    {
        this.canvas = section.querySelector("canvas");
        this.pixels = findings.whole.pixels;
        this.entries = findings.whole.entries; /* for each frame: the index of its finding in the page, or null */
        this.most = this.pixels.reduce((most, pixels) => Math.max(most, pixels ?? 0), 0);
        this.entry = -1;
        this.canvas.addEventListener("click", event => goTo(this.nearest(event.offsetX)));
        addEventListener("resize", () => this.draw());
        section.hidden = this.pixels.length < 2;
        this.label(section, findings);
    }

    label(section, {whole, frames})
    {
        const captions = section.querySelectorAll("div span");
        captions[0].textContent = shortName({frame: whole.ends[0]});
        captions[2].textContent = shortName({frame: whole.ends[1]});
        this.canvas.setAttribute("aria-label", `Pixels that differ in ${this.pixels.length} frames, at most ` +
            `${grouped(this.most)}; the first frame that differs is ${shortName(frames[0])}`);
    }

    /* The index of the finding whose bar is nearest to the coordinate x of the canvas. */
    nearest(x)
    {
        const place = Math.floor(x / this.canvas.clientWidth * this.pixels.length);
        const distance = i => this.entries[i] === null ? Infinity : Math.abs(i - place);
        return this.entries[this.entries.reduce((best, _, i) => distance(i) < distance(best) ? i : best, 0)] ?? 0;
    }

    show(entry)
    {
        this.entry = entry;
        this.draw();
    }

    draw()
    {
        const ratio = devicePixelRatio, {clientWidth: width, clientHeight: height} = this.canvas;
        const context = this.canvas.getContext("2d"), style = getComputedStyle(this.canvas);
        const [line, warm, text] = ["--line", "--warm", "--text"].map(name => style.getPropertyValue(name));
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        context.scale(ratio, ratio);
        context.fillStyle = line;
        context.fillRect(0, height - 1, width, 1);
        const step = width / this.pixels.length, wide = Math.max(step > BAR_GAP ? step - 1 : step, 1);
        this.pixels.forEach((pixels, i) => {
            /* A frame without a count of pixels has a bar of full height. */
            const tall = pixels === null ? height : Math.ceil(barHeight(pixels, this.most) * height);
            context.fillStyle = this.entries[i] === this.entry ? text : warm;
            context.fillRect(i * step, height - tall, wide, tall);
        });
    }
}
