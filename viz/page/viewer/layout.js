/* SPDX-License-Identifier: MIT */
/* layout.js - the parts around the picture: the column of text at the left, the sheets at the right, and the timeline,
 * which can be folded to a strip. */
"use strict";

/* The sheets lie at the same place: opening one closes the other. */
const SHEETS = ["sheet", "tools"];

const LARGE_HEIGHT = 1000; /* CSS pixels; the timeline of a lower window is folded at first */
const LARGE_WIDTH = 760;   /* CSS pixels; in a narrower window the column of text is closed at first */

const isOpen = id => !byId(id).hidden;

function setOpen(id, open)
{
    const opener = document.querySelector(`[data-opens="${id}"]`), leaves = byId(id).contains(document.activeElement);
    for (const other of open && SHEETS.includes(id) ? SHEETS : [])
        if (other !== id)
            setOpen(other, false);
    byId(id).hidden = !open;
    opener.setAttribute("aria-expanded", open);
    if (!open && leaves)
        opener.focus();
}

/* Close the open sheet. Returns false if no sheet is open. */
function closeSheet()
{
    const open = SHEETS.find(isOpen);
    if (open)
        setOpen(open, false);
    return open !== undefined;
}

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
    for (const button of document.querySelectorAll(".close"))
        button.addEventListener("click", closeSheet);
    foldTimeline(innerHeight < LARGE_HEIGHT);
}
