/* SPDX-License-Identifier: MIT */
/* layout.js - the parts around the picture: the column of text at the left, the sheets at the right, and the timeline,
 * which can be folded to a strip. */
"use strict";

const LARGE_HEIGHT = 1000; /* CSS pixels; the timeline of a lower window is folded at first */
const LARGE_WIDTH = 760;   /* CSS pixels; in a narrower window the column of text is closed at first */

/* The parts that lie at the same place, so that opening one closes the others. In a narrow window the column of text lies
 * there, too. */
const sheets = () => ["sheet", "tools", ...(innerWidth > LARGE_WIDTH ? [] : ["column"])];

const isOpen = id => !byId(id).hidden;

function setOpen(id, open)
{
    const opener = document.querySelector(`[data-opens="${id}"]`), leaves = byId(id).contains(document.activeElement);
    if (open && sheets().includes(id))
        sheets().filter(other => other !== id && isOpen(other)).forEach(other => setOpen(other, false));
    byId(id).hidden = !open;
    opener.setAttribute("aria-expanded", open);
    if (!open && leaves)
        opener.focus();
}

/* Close the open sheet. Returns false if no sheet is open. */
function closeSheet()
{
    const open = sheets().find(isOpen);
    if (open)
        setOpen(open, false);
    return open !== undefined;
}

/* ---- The column of text ---------------------------------------------------------------------------------------- */

const SVG = "http://www.w3.org/2000/svg";
const SIGN_SIZE = [20, 16], SCALE_SIZE = [224, 36]; /* the size of a symbol, and of a colour bar with its numbers */

function drawing(name, attributes, content = "")
{
    const made = document.createElementNS(SVG, name);
    made.append(content);
    for (const [key, value] of Object.entries(attributes))
        made.setAttribute(key, value);
    return made;
}

/* Draw a sign of the legend: rectangles as [x, y, width, height, color], and texts as [x, text]. Rectangles of one color
 * become one path. */
function drawSign(parts)
{
    const texts = parts.filter(part => part.length === 2), paths = {};
    const [width, height] = texts.length > 0 ? SCALE_SIZE : SIGN_SIZE;
    const sign = drawing("svg", {viewBox: `0 0 ${width} ${height}`, width, height, "aria-hidden": texts.length === 0});
    for (const [x, y, wide, high, color] of parts.filter(part => part.length > 2))
        paths[color] = `${paths[color] ?? ""}M${x} ${y}h${wide}v${high}h${-wide}z`;
    for (const [fill, d] of Object.entries(paths))
        sign.append(drawing("path", {fill, d}));
    for (const [x, text] of texts)
        sign.append(drawing("text", {x, y: height - 4, fill: "currentColor"}, text));
    return sign;
}

function colored(name, text, color)
{
    const made = element(name, text);
    made.style.color = color ?? "";
    return made;
}

/* The element that shows a row (layers/pen.h). */
function rowElement({title, text, sign, name, detail = "", value, name_color, color, rule})
{
    if (rule)
        return element("hr");
    if (title !== undefined)
        return element("h2", title);
    if (name === undefined && !sign)
        return colored("p", text, color);
    const row = element("div", sign ? drawSign(sign) : colored("span", name, name_color), {class: sign ? "symbol" : "row"});
    row.append(...(sign ? [element("span", text)] : [element("span", detail), colored("span", value, color)]));
    return row;
}

/* Show the rows of the column of text. Empty lines are left out, and so is a rule that follows another rule or is the
 * last row. The caption stands below the picture. */
function showRows(all)
{
    const rows = all.filter(({caption}) => caption === undefined), {caption} = all.find(row => row.caption) ?? {};
    byId("words").textContent = caption ?? "";
    const isNeeded = (row, i) => row.rule ? rows[i + 1] && !rows[i + 1].rule : !row.sign || row.text || row.sign.length > 0;
    byId("column").replaceChildren(...rows.filter(isNeeded).map(rowElement));
}

/* ---- Recorded pixels ------------------------------------------------------------------------------------------- */

/* Show pictures pixel for pixel, or let them fill the window. */
function showExact(exact, [width, height])
{
    const {style} = byId("stage");
    document.body.classList.toggle("exact", exact);
    byId("pixels").setAttribute("aria-pressed", exact);
    style.setProperty("--width", `${width / devicePixelRatio}px`);
    style.setProperty("--height", `${height / devicePixelRatio}px`);
}

/* ---- The timeline ---------------------------------------------------------------------------------------------- */

function foldTimeline(folded)
{
    byId("timeline").classList.toggle("folded", folded);
    byId("fold").setAttribute("aria-expanded", !folded);
    byId("fold").setAttribute("aria-label", folded ? "Open the timeline" : "Fold the timeline");
}

const isFolded = () => byId("timeline").classList.contains("folded");

function arrange()
{
    for (const button of document.querySelectorAll("[data-opens]")) {
        button.addEventListener("click", () => setOpen(button.dataset.opens, !isOpen(button.dataset.opens)));
        setOpen(button.dataset.opens, false);
    }
    for (const opens of hasModule() ? [] : ["column", "tools"])
        document.querySelector(`[data-opens="${opens}"]`).hidden = true;
    for (const button of document.querySelectorAll(".close"))
        button.addEventListener("click", closeSheet);
    setOpen("column", hasModule() && innerWidth > LARGE_WIDTH);
    foldTimeline(innerHeight < LARGE_HEIGHT);
}
