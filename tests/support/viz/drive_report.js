/* SPDX-License-Identifier: MIT */
/* drive_report.js - uses a page of evidence like a user, and reports what it shows in lines "name<tab>value". It waits
 * for states that the page shows, and never for a length of time. */
"use strict";

const said = [], errors = [];
addEventListener("error", event => errors.push(event.message));
addEventListener("unhandledrejection", event => errors.push(String(event.reason)));

function say(what, value)
{
    said.push(`${what}\t${value}\n`);
}

const wait = ms => new Promise(done => setTimeout(done, ms));
const at = id => document.getElementById(id);
const textOf = id => at(id).textContent.trim();
const shownFrame = () => document.body.dataset.frame;

async function until(isSo, what)
{
    for (let i = 0; !isSo(); i++) {
        if (i > 100000)
            throw new Error(`waited for ${what}`);
        await wait(1);
    }
}

/* True if the requested frame is completely visible. */
const settled = () => until(() => shownFrame() === textOf("frame"), `the pictures of ${textOf("frame")}`);

function press(key, target = document.body)
{
    target.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
}

const isSeen = pane => getComputedStyle(pane).display !== "none" && getComputedStyle(pane).visibility !== "hidden";
const panesSeen = () => [...document.querySelectorAll(".pane")].filter(isSeen);
const names = panes => panes.map(pane => pane.dataset.picture).join(" ");

/* The pixel of the picture in the middle of a pane. */
function pixelInMiddle(pane)
{
    const place = new DOMMatrix(getComputedStyle(pane.querySelector("img")).transform);
    return [(pane.clientWidth / 2 - place.e) / place.a, (pane.clientHeight / 2 - place.f) / place.a]
        .map(Math.floor).join(",");
}

function colorAt(which, x, y)
{
    const image = document.querySelector(`.pane[data-picture="${which}"] img`), canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return [...context.getImageData(x, y, 1, 1).data].slice(0, 3).join(",");
}

function sayFrame(name)
{
    say(name, `${shownFrame()} | ${textOf("cause")} | ${names([...document.querySelectorAll(".pane:has(img)")])} | ${
                  at("stage").dataset.mode}`);
}

async function sayKeys()
{
    for (const key of ["n", "ArrowRight", "p", "ArrowLeft", "p", "End", "n", "Home", "j", "k"]) {
        press(key);
        await settled();
        say(`key ${key}`, shownFrame());
    }
}

async function sayFrames()
{
    for (let i = 0; i < 6; i++, press("n")) {
        await settled();
        sayFrame(`frame ${i}`);
        say(`details ${i}`, at("details").hidden ? "none" : textOf("details"));
        say(`facts ${i}`, [...at("facts-of-frame").children].map(fact => fact.textContent).join("; "));
    }
    press("Home");
    await settled();
}

function sayModes()
{
    for (const key of ["d", "t", "e", "c", "s"]) {
        press(key);
        say(`mode ${key}`, `${at("stage").dataset.mode}: ${names(panesSeen())}: ${
                               document.querySelector('#modes [aria-pressed="true"]').dataset.mode}`);
    }
    document.querySelector('[data-mode="difference"]').click();
    say("mode by button", at("stage").dataset.mode);
    press("s");
}

const clip = which => getComputedStyle(document.querySelector(`[data-picture="${which}"]`)).clipPath;

function saySwipe()
{
    const stage = at("stage"), box = stage.getBoundingClientRect(), y = box.top + 20;
    stage.setPointerCapture = () => {}; /* there is no pointer to capture */
    stage.dispatchEvent(new PointerEvent("pointerdown", {clientX: box.left + box.width / 4, clientY: y, button: 0}));
    say("swipe pressed", `${clip("expected")} ${clip("actual")}`);
    stage.dispatchEvent(new PointerEvent("pointermove", {clientX: box.right + 50, clientY: y}));
    say("swipe dragged", at("handle").getAttribute("aria-valuenow"));
    stage.dispatchEvent(new PointerEvent("pointerup", {}));
    stage.dispatchEvent(new PointerEvent("pointermove", {clientX: box.left, clientY: y}));
    say("swipe let go", at("handle").getAttribute("aria-valuenow"));
    press("[");
    press("ArrowLeft", at("handle"));
    say("swipe by keys", at("handle").getAttribute("aria-valuenow"));
}

/* Report the visible picture after each change. */
async function sayBlink()
{
    const seen = [];
    press("b");
    for (let i = 0; i < 4; i++) {
        const before = names(panesSeen());
        seen.push(before);
        if (i < 3)
            await until(() => names(panesSeen()) !== before, "a blink");
    }
    say("blink", seen.join(" "));
    press(" ");
    const byHand = [names(panesSeen())];
    await wait(1500);
    byHand.push(names(panesSeen()));
    press(" ");
    byHand.push(names(panesSeen()));
    say("blink by hand", byHand.join(" "));
    press("s");
}

function sayZoom()
{
    const scale = () => Number.parseFloat(textOf("scale")), whole = scale();
    press("z");
    say("worst in the middle", pixelInMiddle(panesSeen()[0]));
    say("worst is larger", scale() > whole && scale() >= 400);
    press("z");
    say("worst and back", scale() === whole);
    press("+");
    say("larger", scale() > whole);
    press("-");
    press("-");
    say("not smaller than all of it", scale() === whole);
    press("t");
    press("z");
    say("beside each other alike", panesSeen().map(pixelInMiddle).join(" "));
    press("0");
    press("s");
    const box = at("stage").getBoundingClientRect();
    panesSeen()[0].dispatchEvent(new WheelEvent("wheel", {deltaY: -600, clientX: box.left, clientY: box.top, bubbles: true}));
    say("wheel", scale() > 2 * whole);
    press("0");
}

function sayMarks()
{
    const rings = () => [...document.querySelectorAll(".ring")].filter(ring => getComputedStyle(ring).display !== "none");
    say("marks", rings().length > 0);
    press("m");
    say("marks off", rings().length);
    press("m");
}

async function sayAddress()
{
    press("d");
    press("n");
    await settled();
    await until(() => location.hash.includes("difference"), "the address");
    say("address", location.hash);
    location.hash = "#frame=frame_000003.png&mode=blink";
    await until(() => textOf("frame") === "frame_000003.png", "the address to lead there");
    await settled();
    say("from address", `${shownFrame()} ${at("stage").dataset.mode}`);
    location.hash = "#frame=nonsense&mode=constructor";
    await until(() => textOf("frame") === "frame_000000.png", "the address to lead there");
    say("from nonsense", "frame_000000.png");
    press("s");
}

function sayHelp()
{
    say("help before", at("help").open);
    press("?");
    say("help", at("help").open);
    say("keys listed", [...at("help").querySelectorAll("kbd")].map(key => key.textContent).join(" "));
    press("End");
    say("behind the help", textOf("frame"));
    at("help").close();
}

/* Select findings by keys and buttons, and report the text that would be saved as accept.txt. */
async function saySelection()
{
    let saved = Promise.resolve("nothing");
    URL.createObjectURL = blob => {
        saved = blob.text();
        return "#saved";
    };
    const boxes = [...at("list").querySelectorAll("input")];
    say("selectable", boxes.slice(0, 6).map(box => !box.disabled).join(" "));
    say("selected before", `${textOf("selected")} ${at("save").disabled} ${textOf("accept-how")}`);
    press("x");
    boxes[2].click();
    say("selected", textOf("selected"));
    say("accept how", textOf("accept-how"));
    HTMLAnchorElement.prototype.click = function() { say("saved as", this.download); };
    at("save").click();
    say("saved", (await saved).trim().replaceAll("\n", " "));
    press("a");
    say("selected no more", textOf("selected"));
    at("select-all").click();
    say("selected all", textOf("selected"));
    at("select-all").click();
    say("selected none", textOf("selected"));
}

/* Report the number of bars, and the frame that a click at their end shows. */
async function sayCurve()
{
    const canvas = document.querySelector("#curve canvas"), context = canvas.getContext("2d"), {left, top, width} =
        canvas.getBoundingClientRect();
    const bars = JSON.parse(at("facts").textContent.split("\n")[0]).pixels.filter((_, i, all) =>
        context.getImageData((i + 0.4) / all.length * canvas.width, canvas.height - 3, 1, 1).data[3] > 0);
    say("bars", `${bars.length} ${[...document.querySelectorAll("#curve span")].map(span => span.textContent).join("; ")}`);
    canvas.dispatchEvent(new MouseEvent("click", {clientX: left + width - 1, clientY: top + 1}));
    await settled();
    say("end of the bars", shownFrame());
    press("Home");
    await settled();
}

async function drive()
{
    await settled();
    for (const id of ["verdict", "about", "headline", "place"])
        say(id, textOf(id));
    say("title", document.title);
    say("listed", at("list").children.length);
    say("left out", at("left-out").hidden ? "none" : textOf("left-out"));
    say("glows", colorAt("difference", 0, 3));
    say("dim", colorAt("difference", 23, 15));
    await sayCurve();
    await sayKeys();
    await sayFrames();
    sayModes();
    saySwipe();
    await sayBlink();
    sayZoom();
    sayMarks();
    await sayAddress();
    await saySelection();
    sayHelp();
    say("loaded", performance.getEntriesByType("resource").filter(({name}) => !name.startsWith("data:")).length);
}

drive().catch(error => errors.push(error.message)).finally(() => {
    say("errors", errors.join("; ") || "none");
    const list = document.body.appendChild(document.createElement("pre"));
    list.id = "said";
    list.textContent = said.join("");
});
