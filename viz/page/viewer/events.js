/* SPDX-License-Identifier: MIT */
/* events.js - the list of the ticks in which something happened, one row each. Only the rows in sight are elements, and
 * only their ticks are parsed, so the list of 100,000 ticks is as fast as a short one. */
"use strict";

const ROW = 26;   /* the height of a row in CSS pixels; a browser shows at least 600,000 rows of this height */
const BEYOND = 4; /* rows that are made beyond those in sight, so that scrolling shows no gap */

class EventList {
    constructor(root, goTo)
    {
        this.root = root;
        this.rows = element("ol");
        this.root.append(this.rows);
        this.tick = this.bits = this.height = 0;
        this.root.addEventListener("scroll", () => this.draw());
        this.root.addEventListener("click", event => {
            const button = event.target.closest("[data-tick]");
            if (button)
                goTo(Number(button.dataset.tick));
        });
        /* The height is 0 while the list is hidden; nothing is drawn then. */
        new ResizeObserver(() => requestAnimationFrame(() => {
            this.height = this.root.clientHeight;
            this.update();
        })).observe(this.root);
    }

    /* Show another recording, other events, or the same recording after ticks were added to it. `bits` are the listed
     * events; 0: all except "moved". */
    show(recording, bits)
    {
        this.recording = recording;
        this.bits = bits;
        this.ticks = null;
        this.update();
    }

    update()
    {
        if (this.height === 0 || !this.recording)
            return;
        if (!this.ticks) {
            const {events} = this.recording, wanted = this.bits || ~MOVED;
            this.ticks = [];
            events.forEach((event, tick) => event & wanted && this.ticks.push(tick));
            this.rows.style.height = `${ROW * this.ticks.length}px`;
        }
        this.mark(this.tick);
    }

    /* The row of the last listed tick up to a tick; -1 if there is none. */
    rowOf(tick)
    {
        let low = 0, high = this.ticks.length;
        while (low < high) {
            const middle = low + high >> 1;
            if (this.ticks[middle] <= tick)
                low = middle + 1;
            else
                high = middle;
        }
        return low - 1;
    }

    /* Mark the current tick. The list scrolls if its row is out of sight. */
    mark(tick)
    {
        this.tick = tick;
        if (this.height === 0 || !this.ticks)
            return;
        const top = ROW * Math.max(this.rowOf(tick), 0), {scrollTop} = this.root;
        if (top < scrollTop || top + ROW > scrollTop + this.height)
            this.root.scrollTop = top - this.height / 2;
        this.draw();
    }

    draw()
    {
        const first = Math.max(Math.floor(this.root.scrollTop / ROW) - BEYOND, 0);
        const shown = this.ticks.slice(first, first + Math.ceil(this.height / ROW) + 2 * BEYOND);
        this.rows.replaceChildren(...shown.map((tick, i) => this.makeRow(tick, first + i)));
        if (this.ticks.length === 0)
            this.rows.append(element("li", "No events."));
    }

    makeRow(tick, at)
    {
        const attributes = {type: "button", class: "event", "data-tick": tick};
        const button = element("button", element("b", grouped(tick)), attributes);
        const row = element("li", button, {"aria-posinset": at + 1, "aria-setsize": this.ticks.length});
        row.style.top = `${ROW * at}px`;
        if (tick === this.tick)
            button.setAttribute("aria-current", "true");
        button.append(...this.tell(tick));
        button.title = button.textContent;
        return row;
    }

    /* The sentences about the listed events of a tick, each with the sign of its event. */
    tell(number)
    {
        const wanted = this.bits || ~MOVED, tick = this.recording.tick(number);
        try {
            return describeTick(tick, {...sessionHead(), at: () => undefined, node: () => undefined})
                .filter(([event]) => eventBits([event]) & wanted)
                .map(([event, ...parts]) => sentenceOf([event, textOfParts(parts)], "span"));
        } catch {
            return [textOf(tick.events)];
        }
    }
}
