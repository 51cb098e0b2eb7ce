/* SPDX-License-Identifier: MIT */
/* drive.js - shared by the scripts that act like a user of a page: reports of observations as lines "name<tab>value", a
 * clock, random numbers, and digests. */
"use strict";

const said = [], errors = [];

function say(what, value)
{
    said.push(`${what}\t${value}\n`);
}

/* The browser's virtual clock stands still while a script runs, and jumps when the page is idle, which takes a frame
 * for every 16 ms. This clock advances with each reading instead, so that the page stores states and pauses as usual,
 * and timers without a delay run at once. */
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

/* Not Math.random(), so that every run makes the same gestures. */
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

/* Report the scene digest, the pixel digest and the facts of a tick. */
async function sayTick(name, tick)
{
    await until(() => !interaction.busy, "the picture that the page shows");
    await player().goTo(tick);
    const {engine} = player(), picture = engine.draw();
    say(`${name} ${tick}`, `${engine.digest()} ${digestOf(picture.data)} ${engine.facts()}`);
}

/* Run a script, and put its reports into the element "said", in which the test reads them. */
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
