/* SPDX-License-Identifier: MIT */
/* facts.js - the recording: the lines of ticks.jsonl. A line is parsed only when its tick is shown. A tick that is like
 * the tick before it has no line of its own. */
"use strict";

/* The curves of the timeline. Each row has the path of a fact in a tick and the name of the curve. "own" marks a fact
 * of Octreel's tree: if the recording also has foreign nodes, "Octreel's" is added to the name. The value of a list is
 * the number of its entries. A curve without values is left out. */
const CURVES = [
    ["foreign_nodes.count", "foreign nodes"],
    ["foreign_nodes.depth", "foreign depth"],
    ["foreign_nodes.visited", "foreign visits"],
    ["foreign_nodes.wrong.count", "wrong foreign nodes"],
    ["tree.nodes", "nodes", "own"],
    ["tree.depth", "depth", "own"],
    ["tree.points", "points"],
    ["visits.visited", "visits", "own"],
];

/* The events and their signs, in the order of octree_event. A "rare" event comes last, has no key, and has a lane only
 * if it occurs. "own" marks an event of Octreel's tree, as in CURVES. */
const EVENTS = [
    ["moved", "→", "player"],
    ["refused", "⊘"],
    ["collided", "✕"],
    ["full", "■"],
    ["split", "⊞", "own"],
    ["merged", "⊟", "own"],
    ["wrong", "≠", "rare"],
    ["overlapped", "⧉", "rare"],
];

const MOVED = 1;

/* The member of a tick at a path such as ["tree", "nodes"], or undefined if the tick has no such member. */
function factAt(tick, names)
{
    let value = tick;
    for (const name of names)
        value = value?.[name];
    return value;
}

/* The number of entries that octreel left out at the end of a list. The last entry of such a list is {"more":
 * count}. */
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

const EVENT_BITS = new Map(EVENTS.map(([name], i) => [name, 1 << i]));

function eventBits(names)
{
    let bits = 0;
    for (const name of names)
        bits |= EVENT_BITS.get(name) ?? 0;
    return bits;
}

const frameName = tick => `frame_${String(tick).padStart(6, "0")}.png`;

/* The ticks of a recording. Each tick is kept as its line of text, with a few lists of numbers. Parsed ticks are not
 * kept. */
class Recording {
    constructor(about, lines)
    {
        this.about = about;
        this.lines = [];  /* for each tick: its line, or the line of the tick that it repeats */
        this.scenes = []; /* for a tick without a line of its own: its scene digest, or "" if it has no frame */
        this.events = [];
        this.filmed = []; /* for each tick: the last tick up to it that has a frame; -1: no such tick */
        this.curves = CURVES.map(([path, name, of]) => ({path, names: path.split("."), name, of, values: []}));
        lines.forEach(line => this.append(line));
        this.curves = this.curves.filter(curve => !this.length || curve.values.some(value => !isNaN(value)));
        this.hasForeignNodes = this.length > 0 && this.curves.some(({path}) => path.startsWith("foreign_nodes"));
    }

    /* The displayed name of a curve or an event. */
    nameOf(name, of)
    {
        return of === "player" ? `player ${name}` : of === "own" && this.hasForeignNodes ? `Octreel's ${name}` : name;
    }

    static parse(text)
    {
        const lines = text.trim().split("\n");
        return new Recording(JSON.parse(lines[0]), lines.slice(1));
    }

    get length()
    {
        return this.lines.length;
    }

    /* Add a line of the page, parsed as JSON. An object is the line of a tick. A string is the scene digest of a tick
     * that repeats the tick before it. A number is the count of such ticks without a frame. */
    append(line)
    {
        const value = JSON.parse(line);
        if (typeof value === "object") {
            this.lines.push(line);
            this.index(this.length - 1, value);
        } else if (typeof value === "string") {
            this.repeat(value);
        } else {
            for (let i = 0; i < value; i++)
                this.repeat("");
        }
    }

    repeat(scene)
    {
        const i = this.length;
        if (i === 0)
            throw new SyntaxError("no tick comes before the first one");
        this.lines.push(this.lines[i - 1]);
        this.scenes[i] = scene;
        this.events[i] = this.events[i - 1];
        this.filmed[i] = scene ? i : this.filmed[i - 1];
        for (const {values} of this.curves)
            values[i] = values[i - 1];
    }

    /* Returns a recording of the first `length` ticks. */
    cut(length)
    {
        const part = new Recording(this.about, []);
        for (const list of ["lines", "scenes", "events", "filmed"])
            part[list] = this[list].slice(0, length);
        part.hasForeignNodes = this.hasForeignNodes;
        part.curves = this.curves.map(curve => ({...curve, values: curve.values.slice(0, length)}));
        return part;
    }

    tick(i)
    {
        const tick = JSON.parse(this.lines[i]), scene = this.scenes[i];
        if (scene === undefined)
            return tick;
        delete tick.frame;
        delete tick.scene;
        return {...tick, tick: i, ...(scene && {frame: frameName(i), scene})};
    }

    index(i, tick)
    {
        this.events[i] = eventBits(tick.events ?? []);
        this.filmed[i] = tick.frame ? i : this.filmed[i - 1] ?? -1;
        for (const curve of this.curves)
            curve.values[i] = amountOf(factAt(tick, curve.names));
    }

    get hasFrames()
    {
        return this.filmed.at(-1) >= 0;
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
