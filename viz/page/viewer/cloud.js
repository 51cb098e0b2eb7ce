/* SPDX-License-Identifier: MIT */
/* cloud.js - the page of a point cloud, and the measure between two points.
 *
 * A cloud is a session of one tick whose points are a compressed block in the page (formats/point_block.c), like those
 * of a large session. The module decodes it. Only the parts of the page that belong to a game are hidden. */
"use strict";

const NO_POINTS = new Uint8Array(0);

const isCloudPage = document.getElementById("points")?.dataset.cloud !== undefined;

/* Whether a block of points is the cloud of the page. */
const isCloud = points => isCloudPage && points.length > 0;

/* The keys of a cloud's page; the others belong to ticks and to the player. */
const CLOUD_KEYS = ["Shift+ArrowLeft", "Shift+ArrowRight", "Shift+ArrowUp", "Shift+ArrowDown", "Shift+PageUp",
                    "Shift+PageDown", ..."vmcoipl?", "Escape"];

const keysOf = keys => isCloudPage ? keys.filter(([[name]]) => CLOUD_KEYS.includes(name)) : keys;

/* The block of points in the page; empty if the page has none. */
async function unpackPoints()
{
    if (!byId("points"))
        return NO_POINTS;
    try {
        return new Uint8Array(await unpackedPoints);
    } catch {
        throw new Error("the points in this page are cut off or damaged; copy the page or make it again");
    }
}

/* Show or hide the parts of the page that only a game needs. */
function showCloudParts(isCloud)
{
    document.body.classList.toggle("cloud", isCloud);
    if (isCloud)
        byId("hint").textContent = "Drag to turn, scroll to zoom, click to identify.";
}

/* ---- The measure ------------------------------------------------------------------------------------------------- */

const differencesOf = ([from, to]) => to.map((at, i) => at - from[i]);

/* Draw the line between two measured positions, whose pixels are `seen`, and its length. */
function traceMeasure(context, seen, places, ratio)
{
    if (seen.flat().some(isNaN))
        return;
    for (const [x, y] of seen) {
        context.moveTo(x + 4 * ratio, y);
        context.arc(x, y, 4 * ratio, 0, 2 * Math.PI);
    }
    if (seen.length < 2)
        return;
    const [[x, y], [toX, toY]] = seen, text = String(readable(distanceOf(...places)));
    context.moveTo(x, y);
    context.lineTo(toX, toY);
    context.font = `${14 * ratio}px sans-serif`;
    context.textAlign = "center";
    context.save();
    context.strokeStyle = "#000000";
    context.lineWidth = 4 * ratio;
    context.strokeText(text, (x + toX) / 2, (y + toY) / 2 - 8 * ratio);
    context.restore();
    context.fillStyle = MARK_COLOR;
    context.fillText(text, (x + toX) / 2, (y + toY) / 2 - 8 * ratio);
}

/* Measures between two points that the user clicks. A third point begins anew. */
class Measure {
    constructor(live, showStatus)
    {
        this.live = live;
        this.showStatus = showStatus;
        this.stop();
    }

    toggle()
    {
        if (this.isOn) {
            this.stop();
            return;
        }
        this.isOn = true;
        byId("measure").setAttribute("aria-pressed", true);
        this.showStatus("Click two points to measure between them.");
    }

    stop()
    {
        this.isOn = false;
        this.ends = [];
        byId("measure").setAttribute("aria-pressed", false);
        this.show();
    }

    /* Make the point at a clicked pixel an end of the measured line. */
    add({elements})
    {
        const found = elements.find(({point}) => point)?.point;
        if (!found) {
            this.showStatus("There is no point: click a point to measure.");
            return;
        }
        const place = this.live.engine.point(found.id) ?? found.position;
        this.ends = [...this.ends.slice(this.ends.length === 2 ? 2 : 0), {id: found.id, place}];
        this.showStatus(this.ends.length === 2 ? "" : "Click the other point.");
        this.show();
    }

    show()
    {
        const places = this.ends.map(({place}) => place), sheet = byId("measured");
        this.live.measured = places;
        sheet.hidden = places.length === 0;
        sheet.replaceChildren(element("h2", "Distance"), element("dl"));
        const row = (name, ...parts) => {
            const made = element("div", element("dt", name), {class: "fact"}), value = element("dd");
            value.append(...parts);
            made.append(value);
            sheet.lastChild.append(made);
        };
        this.ends.forEach(({id, place}, i) => row(i ? "to" : "from", pointLink(id), " at ", placeText(place)));
        if (places.length === 2) {
            const differences = differencesOf(places);
            row("distance", numberText(distanceOf(...places)));
            differences.forEach((difference, i) => row(`d${AXES[i]}`, numberText(difference)));
        }
        if (this.live.isShown)
            this.live.mark();
    }
}
