/* SPDX-License-Identifier: MIT */
/* panel.js - elements, numbers and lists as text, and rows for members of ticks.jsonl that the inspector does not tell
 * in words. The name of a row is the member's name with spaces in place of underscores. */
"use strict";

const KEY_MEANINGS = {
    __proto__: null,
    w: "+y", s: "−y", d: "+x", a: "−x", e: "+z", f: "−z", n: "nearest neighbour", ".": "wait", q: "end",
};

/* Lists that are shown without a count beside their names, because a position is a single thing. */
const NOT_COUNTED = new Set(["player", "attempt", "position", "target", "min", "max", "center"]);

const ABSENT = "–";

function element(name, content = "", attributes = {})
{
    const made = document.createElement(name);
    made.append(content);
    for (const [key, value] of Object.entries(attributes))
        made.setAttribute(key, value);
    return made;
}

/* A number with at most three decimals and commas between thousands, as in "12,345.5". Number.toLocaleString() would
 * load the browser's tables of languages, which delays the first picture by 10 ms. */
function grouped(number)
{
    const [whole, decimals] = String(Math.round(number * 1000) / 1000).split(".");
    return whole.replace(/\B(?=(\d{3})+$)/g, ",") + (decimals ? `.${decimals}` : "");
}

/* A count with its noun: "1 tick", "2 ticks". */
function counted(count, noun)
{
    return `${grouped(count)} ${noun}${count === 1 ? "" : "s"}`;
}

/* The text of a value as in ticks.jsonl: the shortest text of a number, and "-0" for negative zero. */
function textOf(value)
{
    return value === null ? ABSENT : Object.is(value, -0) ? "-0" : String(value);
}

/* The number of digits that are shown; the tooltip shows all digits. */
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

/* The number of entries of a list that are shown before "more". */
const OPEN_ENTRIES = 10;

/* The remaining entries of a long list, folded into an element that the user can open. */
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

function showValue(value, path)
{
    if (Array.isArray(value))
        return showList(value, path);
    return isPlain(value) ? [showPlain([value])] : [showObject(value, path)];
}

/* Show the name of a fact. For a list, the number of its entries is added. */
function showTerm(name, value)
{
    const term = element("dt", name.replaceAll("_", " "));
    if (Array.isArray(value) && value.length > 0 && !NOT_COUNTED.has(name))
        term.append(" ", element("span", grouped(listLength(value)), {class: "count"}));
    return term;
}

/* Show a fact. The members of an object stand below its name; a plain value stands beside its name. */
function showFact(name, value, path)
{
    const description = element("dd", "", {"data-fact": path});
    description.append(...showValue(value, path));
    const nested = description.querySelector("dl") !== null;
    const row = element("div", showTerm(name, value), {class: nested ? "fact nested" : "fact"});
    row.append(description);
    return row;
}
