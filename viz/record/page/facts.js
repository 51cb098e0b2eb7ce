/* SPDX-License-Identifier: MIT */
/* facts.js - what the recording says: the lines of ticks.jsonl, read one by one when they are wanted. */
"use strict";

/* The curves: where a tick has the fact, and its name. One line more is one curve more. Of a fact that is a list the
 * entries are counted; a curve that no tick has a fact for is left out. */
const CURVES = [
    ["tree.nodes", "nodes"],
    ["tree.depth", "depth"],
    ["tree.points", "points"],
    ["visits.visited", "visits"],
];

/* The events and their signs, in the order of octree_event. */
const EVENTS = [
    ["moved", "→"],
    ["refused", "⊘"],
    ["collided", "✕"],
    ["full", "■"],
    ["split", "⊞"],
    ["merged", "⊟"],
];

const MOVED = 1;

/* The member at a path such as "tree.nodes", or undefined. */
function factAt(tick, path)
{
    return path.split(".").reduce((value, name) => value?.[name], tick);
}

/* A list was cut off by octreel when its last entry is {"more": how many}. */
function leftOut(list)
{
    return list.at(-1)?.more ?? 0;
}

function keptEntries(list)
{
    return leftOut(list) ? list.slice(0, -1) : list;
}

function listLength(list)
{
    return keptEntries(list).length + leftOut(list);
}

function amountOf(value)
{
    if (Array.isArray(value))
        return listLength(value);
    return typeof value === "number" ? value : NaN;
}

function eventBits(names)
{
    return EVENTS.reduce((bits, [name], i) => names.includes(name) ? bits | 1 << i : bits, 0);
}

/* Ten thousand ticks are ten thousand strings and a few typed arrays; of the parsed ticks none is kept. */
class Recording {
    constructor(text)
    {
        const lines = text.trim().split("\n");
        this.about = JSON.parse(lines[0]);
        this.lines = lines.slice(1);
        this.length = this.lines.length;
        this.events = new Uint32Array(this.length);
        this.filmed = new Int32Array(this.length).fill(-1); /* the tick whose frame is the latest at this one */
        this.curves = CURVES.map(([path, name]) => ({path, name, values: new Float64Array(this.length)}));
        for (let i = 0; i < this.length; i++)
            this.index(i, this.tick(i));
        this.curves = this.curves.filter(curve => curve.values.some(value => !isNaN(value)));
    }

    tick(i)
    {
        return JSON.parse(this.lines[i]);
    }

    index(i, tick)
    {
        this.events[i] = eventBits(tick.events ?? []);
        this.filmed[i] = tick.frame ? i : this.filmed[i - 1] ?? -1;
        for (const curve of this.curves)
            curve.values[i] = amountOf(factAt(tick, curve.path));
    }

    hasFrame(i)
    {
        return this.filmed[i] === i;
    }

    count(bits)
    {
        return this.events.reduce((count, events) => count + (events & bits ? 1 : 0), 0);
    }
}
