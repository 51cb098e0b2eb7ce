/* SPDX-License-Identifier: MIT */
/* drive.js - what the scripts that play a page share: a line "what<tab>value" of what they see, a clock and random
 * numbers of their own, and digests. */
"use strict";

const said = [], errors = [];

function say(what, value)
{
    said.push(`${what}\t${value}\n`);
}

/* The browser's own clock stands still while a script runs, and leaps where nothing is to be done, with a picture of
 * the page every 16 ms of it. Here each look at the clock is a while later, so that the page keeps states and rests,
 * and what the page does next it does at once. */
let clock = 0;
performance.now = () => clock += 2;

const later = window.setTimeout.bind(window), due = [], bell = new MessageChannel();
bell.port1.onmessage = () => due.shift()();

function atOnce(act)
{
    due.push(act);
    bell.port2.postMessage(0);
    return 0;
}

window.setTimeout = (act, ms = 0) => ms > 0 ? later(act, ms) : atOnce(act);
window.requestAnimationFrame = atOnce;

async function until(isSo, what)
{
    for (let i = 0; !isSo(); i++) {
        if (i > 200000)
            throw new Error(`waited for ${what}`);
        await new Promise(done => setTimeout(done, i % 50 === 49 ? 1 : 0));
    }
}

/* A generator of its own: the same gestures every time. */
let seed = 1;

function random(below)
{
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return Math.floor(seed / 2 ** 32 * below);
}

function digestOf(bytes)
{
    let digest = 0x811c9dc5;
    for (let i = 0; i < bytes.length; i++)
        digest = Math.imul(digest ^ bytes[i], 0x01000193);
    return (digest >>> 0).toString(16).padStart(8, "0");
}

const interaction = typeof octreel === "object" ? octreel.interaction : undefined;
const player = () => interaction.player;

/* The tick as it is played, its scene and its pixels. */
async function sayTick(name, tick)
{
    await until(() => !interaction.busy, "the picture that the page shows");
    await player().goTo(tick);
    const {engine} = player(), picture = engine.draw();
    say(`${name} ${tick}`, `${engine.digest()} ${digestOf(picture.data)} ${engine.facts()}`);
}

/* Run to the end, and leave what was said where the test finds it. */
function run(drive)
{
    addEventListener("error", event => errors.push(event.message));
    addEventListener("unhandledrejection", event => errors.push(event.reason));
    drive().then(() => {
        say("errors", errors.join(" "));
        const list = document.body.appendChild(document.createElement("pre"));
        list.id = "said";
        list.textContent = said.join("");
    }).catch(error => { document.body.textContent = error.stack; });
}
