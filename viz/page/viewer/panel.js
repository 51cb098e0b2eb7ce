/* SPDX-License-Identifier: MIT */
/* panel.js - the facts of one tick, beside its frame: all that its line of ticks.jsonl has, in its order and under its
 * names, so that a new fact needs no change here. */
"use strict";

const KEY_MEANINGS = {
    w: "+y", s: "−y", d: "+x", a: "−x", e: "+z", f: "−z", n: "nearest neighbour", ".": "wait", q: "end",
};

/* Positions are lists of three numbers and yet one thing; events are few and seen at a glance. */
const NOT_COUNTED = new Set(["player", "attempt", "position", "target", "min", "max", "center", "events"]);

const ABSENT = "–";

function element(name, content = "", attributes = {})
{
    const made = document.createElement(name);
    made.append(content);
    for (const [key, value] of Object.entries(attributes))
        made.setAttribute(key, value);
    return made;
}

function grouped(number)
{
    return number.toLocaleString("en");
}

/* "1 tick", "2 ticks". */
function counted(count, noun)
{
    return `${grouped(count)} ${noun}${count === 1 ? "" : "s"}`;
}

/* The digits of ticks.jsonl: a number's shortest text, minus zero included. */
function textOf(value)
{
    return value === null ? ABSENT : Object.is(value, -0) ? "-0" : String(value);
}

/* Seven digits are enough to read: all of them are in the tooltip. */
const READ_DIGITS = 7;

function readable(value)
{
    return typeof value === "number" && !Number.isInteger(value) ? Number(value.toPrecision(READ_DIGITS)) : value;
}

function showPlain(values)
{
    const exact = values.map(textOf).join(", "), read = values.map(readable).map(textOf).join(", ");
    return read === exact ? exact : element("span", read, {title: exact});
}

/* As many of a list as stand open. */
const OPEN_ENTRIES = 10;

/* A longer list opens when it is wanted. */
function folded(list)
{
    const rest = element("details", element("summary", `${grouped(listLength(list) - OPEN_ENTRIES)} more`));
    rest.append(showPlain(keptEntries(list).slice(OPEN_ENTRIES)), ...showMore(list));
    return rest;
}

function isPlain(value)
{
    return value === null || typeof value !== "object";
}

function absent()
{
    return element("span", ABSENT, {class: "absent"});
}

function showMore(list)
{
    const more = leftOut(list);
    return more ? [element("p", `… and ${grouped(more)} more, in ticks.jsonl`, {class: "more"})] : [];
}

function showList(list, path)
{
    if (list.length === 0)
        return [absent()];
    const kept = keptEntries(list);
    if (kept.every(isPlain) && kept.length > OPEN_ENTRIES + 1)
        return [showPlain(kept.slice(0, OPEN_ENTRIES)), folded(list)];
    if (kept.every(isPlain))
        return [showPlain(kept), ...showMore(list)];
    return [...kept.map((entry, i) => showObject(entry, `${path}.${i}`)), ...showMore(list)];
}

function showObject(object, path)
{
    const list = element("dl");
    for (const [name, value] of Object.entries(object))
        list.append(showFact(name, value, `${path}.${name}`));
    return list;
}

function showEvents(names)
{
    if (names.length === 0)
        return [absent()];
    return names.map(name => {
        const sign = EVENTS.find(([known]) => known === name)?.[1] ?? "•";
        const badge = element("span", name, {class: "badge", "data-event": name});
        badge.prepend(element("span", sign, {class: "sign", "aria-hidden": "true"}));
        return badge;
    });
}

function showKey(key)
{
    const meaning = KEY_MEANINGS[key];
    return key === null ? [absent()] : [element("kbd", key), ...(meaning ? [element("small", meaning)] : [])];
}

const SHOWN_AS = {
    events: showEvents,
    key: showKey,
    frame: name => [element("a", name, {href: `./${name}`, target: "_blank"})], /* a file here, whatever its name */
};

function showValue(value, path)
{
    if (SHOWN_AS[path])
        return SHOWN_AS[path](value);
    if (Array.isArray(value))
        return showList(value, path);
    return isPlain(value) ? [showPlain([value])] : [showObject(value, path)];
}

/* A name, and of a list how many entries it has. */
function showTerm(name, value)
{
    const term = element("dt", name);
    if (Array.isArray(value) && value.length > 0 && !NOT_COUNTED.has(name))
        term.append(" ", element("span", grouped(listLength(value)), {class: "count"}));
    return term;
}

/* What holds facts of its own stands below its term, the rest beside it. */
function showFact(name, value, path)
{
    const description = element("dd", "", {"data-fact": path});
    description.append(...showValue(value, path));
    const nested = description.querySelector("dl") !== null;
    const row = element("div", showTerm(name, value), {class: nested ? "fact nested" : "fact"});
    row.append(description);
    return row;
}

function showTick(panel, tick)
{
    panel.replaceChildren();
    for (const [name, value] of Object.entries(tick))
        panel.append(showFact(name, value, name));
}
