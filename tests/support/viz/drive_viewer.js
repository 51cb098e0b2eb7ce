/* SPDX-License-Identifier: MIT */
/* drive_viewer.js - uses a recording's page like a user, and reports what it shows in lines "name<tab>value". */
"use strict";

const said = [];

function say(what, value)
{
    said.push(`${what}\t${value}\n`);
}

const wait = ms => new Promise(done => setTimeout(done, ms));

/* Wait for a state of the page, however long it takes. The browser's virtual clock cannot limit the wait: it jumps
 * ahead when the page waits for other processes, which decode pictures in real time. */
async function until(isSo, what)
{
    for (let i = 0; !isSo(); i++) {
        if (i > 100000)
            throw new Error(`waited for ${what}`);
        await wait(1);
    }
}

const tickShown = () => document.body.dataset.tick;

function press(key)
{
    document.body.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
}

function slideTo(tick)
{
    const slider = document.getElementById("slider");
    slider.value = tick;
    slider.dispatchEvent(new Event("input"));
}

/* Report the facts of every tick: as JSON, as sentences, and in the curves. */
function sayFacts()
{
    press("i");
    slideTo(0);
    const raw = document.querySelector(".raw"), textsOf = selector =>
        [...document.querySelectorAll(selector)].map(({textContent}) => textContent).join(" | ");
    raw.open = true;
    raw.dispatchEvent(new Event("toggle"));
    for (let tick = 0; tick <= Number(document.getElementById("slider").max); tick++) {
        slideTo(tick);
        say(`${tick} raw`, JSON.stringify(JSON.parse(raw.querySelector("pre").textContent)));
        say(`${tick} told`, textsOf(".happened"));
        say(`${tick} sections`, textsOf(".told"));
        for (const value of document.querySelectorAll("#timeline .curve + output"))
            say(`${tick} curve ${value.dataset.lane}`, value.textContent);
    }
}

function sayKeys()
{
    for (const key of ["Home", "ArrowLeft", "ArrowRight", "ArrowRight", "ArrowLeft", "End", "ArrowRight", "PageUp",
                       "PageDown", "PageUp", "Home", "PageDown"]) {
        press(key);
        say(`key ${key}`, tickShown());
    }
}

/* Report the ticks that a key reaches, until nothing changes. */
function sayWalk(name, key)
{
    const ticks = [];
    for (let before = ""; before !== tickShown(); press(key))
        ticks.push(before = tickShown());
    say(name, ticks.join(" "));
}

function sayMatches()
{
    press("Home");
    sayWalk("walk any", "j");
    press("3");
    press("Home");
    sayWalk("walk collided", "j");
    sayWalk("walk back", "k");
    say("filtered", document.getElementById("filtered").textContent);
    say("chosen", [...document.querySelectorAll('.lane-label[aria-pressed="true"]')].map(label => label.dataset.event).join(" "));
    document.querySelector('.lane-label[data-event="merged"]').click();
    press("Home");
    sayWalk("walk collided or merged", "j");
    press("0");
    say("chosen none", document.querySelectorAll('.lane-label[aria-pressed="true"]').length);
}

function sayPointer()
{
    const scrub = document.getElementById("scrub"), box = scrub.getBoundingClientRect();
    const typed = document.getElementById("tick");
    scrub.setPointerCapture = () => {}; /* there is no pointer to capture */
    scrub.dispatchEvent(new PointerEvent("pointerdown", {clientX: box.left + box.width / 2, button: 0, buttons: 1}));
    say("click in the middle", tickShown());
    scrub.dispatchEvent(new PointerEvent("pointermove", {clientX: box.right, buttons: 1}));
    say("drag to the end", tickShown());
    typed.value = "77";
    typed.dispatchEvent(new Event("change"));
    say("typed", tickShown());
    document.querySelector('[data-does="next"]').click();
    say("button", tickShown());
}

/* The lanes show a part of the ticks, and follow the current tick. */
async function sayZoom()
{
    const {timeline} = octreel, scrub = document.getElementById("scrub"), box = scrub.getBoundingClientRect();
    const part = async () => {
        await until(() => !timeline.drawing, "the lanes");
        const bar = document.getElementById("range").hidden ? "" : ", range bar";
        return `${Math.round(timeline.from)} to ${Math.round(timeline.to)}${bar}`;
    };
    const clientX = box.left + box.width / 2;
    const wheel = more => scrub.dispatchEvent(new WheelEvent("wheel", {clientX, cancelable: true, ...more}));
    slideTo(100);
    press("z");
    press("z");
    say("zoomed", await part());
    scrub.dispatchEvent(new PointerEvent("pointerdown", {clientX, button: 0, buttons: 1}));
    scrub.dispatchEvent(new PointerEvent("pointerup"));
    say("click in the part", tickShown());
    slideTo(250);
    say("followed", await part());
    wheel({deltaX: -1e6});
    say("panned", await part());
    wheel({deltaY: -1e6});
    say("as far as it goes", await part());
    press("x");
    wheel({deltaY: 1e6});
    say("zoomed out", await part());
}

async function sayEvents()
{
    const list = document.getElementById("events"), rows = () => [...list.querySelectorAll("button")];
    slideTo(225);
    press("b");
    await until(() => list.querySelector("[aria-current]"), "the list of events");
    const at = rows().findIndex(row => row.hasAttribute("aria-current"));
    say("events", rows().slice(at - 2, at + 2).map(row => row.textContent).join(" | "));
    say("rows made", rows().length < 40 && rows().length);
    rows()[at - 2].click();
    say("event clicked", `${tickShown()} ${list.querySelector("[aria-current]").textContent.slice(0, 3)}`);
    press("3");
    say("events collided", octreel.timeline.list.ticks.join(" "));
    slideTo(0);
    say("first event", rows()[0].textContent);
    press("0");
    press("1");
    say("events moved", octreel.timeline.list.ticks.length);
    press("0");
    press("b");
}

async function sayFrame(name)
{
    const shown = () => document.querySelector("#stage img");
    const file = `frame_${tickShown().padStart(6, "0")}.png`;
    await until(() => shown()?.getAttribute("src") === file && shown().naturalWidth > 0, file);
    say(name, `${tickShown()} ${shown().getAttribute("src")} ${shown().naturalWidth}x${shown().naturalHeight}`);
}

const isPlaying = () => document.body.classList.contains("playing");

/* Play until the page stops by itself, or has shown this number of ticks. */
async function sayPlayed(name, most)
{
    const seen = [];
    let last = tickShown();
    press(" ");
    await until(() => {
        if (last !== tickShown())
            seen.push(last = tickShown());
        return seen.length >= most || !isPlaying();
    }, name);
    say(name, seen.join(" "));
    if (isPlaying())
        press(" ");
    const paused = tickShown();
    await wait(500);
    say(`${name}, paused`, paused === tickShown());
}

async function sayAddress()
{
    press("3");
    slideTo(41);
    await until(() => location.hash.startsWith("#t=41"), "address");
    say("address", location.hash);
    location.hash = "#t=12&filter=full,split,unheard-of";
    await until(() => tickShown() === "12", "from address");
    say("from address", `${tickShown()} ${document.querySelectorAll('.lane-label[aria-pressed="true"]').length}`);
    location.hash = "#t=99999999";
    await until(() => tickShown() !== "12", "beyond the end");
    say("beyond the end", tickShown());
    location.hash = "#t=nonsense";
    await until(() => tickShown() === "0", "from nonsense");
    say("from nonsense", tickShown());
}

function sayHelp()
{
    const help = document.getElementById("help");
    say("help before", help.open);
    press("?");
    say("help", help.open);
    say("keys listed", [...help.querySelectorAll("kbd")].map(key => key.textContent).join(" "));
    press("End");
    say("behind the help", tickShown());
    help.close();
}

async function drive()
{
    if (octreel.interaction.canPlay)
        await octreel.interaction.start(); /* sentences then have positions */
    press("p"); /* show the recorded frames */
    sayFacts();
    sayKeys();
    sayMatches();
    sayPointer();
    await sayFrame("frame");
    await sayZoom();
    await sayEvents();
    press("Home");
    await sayPlayed("played", 12);
    press("Home");
    press("3");
    await sayPlayed("played collided", Infinity);
    press("0");
    await sayAddress();
    sayHelp();
    say("elements", document.querySelectorAll("*").length);
    say("errors", errors.length);
    const list = document.body.appendChild(document.createElement("pre"));
    list.id = "said";
    list.textContent = said.join("");
}

const errors = [];
addEventListener("error", event => errors.push(event.message));
drive().catch(error => { document.body.textContent = error.message; });
