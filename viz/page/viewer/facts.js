/* SPDX-License-Identifier: MIT */
/* facts.js - what the recording says: the lines of ticks.jsonl, read one by one when they are wanted. */
"use strict";

/* The curves: where a tick has the fact, and its name; "own" is of Octreel's tree, and is called so where there is a
 * program's too. One line more is one curve more. Of a fact that is a list the entries are counted; a curve that no tick
 * has a fact for is left out. */
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

/* The events and their signs, in the order of octree_event. One that is rare comes last, has no key, and has a lane only
 * where there is one; "own" as above. */
const EVENTS = [
    ["moved", "→"],
    ["refused", "⊘"],
    ["collided", "✕"],
    ["full", "■"],
    ["split", "⊞", "own"],
    ["merged", "⊟", "own"],
    ["wrong", "≠", "rare"],
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

/* Ten thousand ticks are ten thousand strings and a few lists of numbers; of the parsed ticks none is kept. */
class Recording {
    constructor(about, lines)
    {
        this.about = about;
        this.lines = [];
        this.events = [];
        this.filmed = []; /* the tick whose frame is the latest at this one; -1: none is */
        this.curves = CURVES.map(([path, name, of]) => ({path, name, of, values: []}));
        lines.forEach(line => this.append(line));
        this.curves = this.curves.filter(curve => !this.length || curve.values.some(value => !isNaN(value)));
        this.hasForeignNodes = this.length > 0 && this.curves.some(({path}) => path.startsWith("foreign_nodes"));
    }

    /* What a curve or an event is called. */
    nameOf(name, of)
    {
        return of === "own" && this.hasForeignNodes ? `Octreel's ${name}` : name;
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

    append(line)
    {
        this.lines.push(line);
        this.index(this.length - 1, this.tick(this.length - 1));
    }

    /* The first `length` ticks. */
    cut(length)
    {
        const part = new Recording(this.about, []);
        for (const list of ["lines", "events", "filmed"])
            part[list] = this[list].slice(0, length);
        part.hasForeignNodes = this.hasForeignNodes;
        part.curves = this.curves.map(curve => ({...curve, values: curve.values.slice(0, length)}));
        return part;
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
