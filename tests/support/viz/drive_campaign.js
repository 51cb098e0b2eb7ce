/* SPDX-License-Identifier: MIT */
/* drive_campaign.js - makes this number of random inputs (`given.inputs`), as events of the page: keys, drags, clicks,
 * wheels, scrubs, controls, queries, dropped files. At intervals it compares the page with a separate engine that plays
 * the same session from its beginning. */
"use strict";

const INPUTS_A_CHECK = 150, MOST_FINDINGS = 20;
const NASTY = ["", "NaN", "-1", "1e308", "0", "1,2", "z=0", "x=nan", "2:5", "9:1", "1,1,1,-1,-1,-1", "-400,-400,-400,400,400,400",
               "100", "0.5", "<b>", "2,2,2"];
const KEYS_PRESSED = ["ArrowRight", "ArrowLeft", "PageDown", "PageUp", "Home", "End", " ", "+", "-", "j", "k", "1", "2", "3",
                      "4", "5", "6", "0", ..."wsdaefn.qwsdaef", "c", "Escape", "?", "x", ..."oivtplbz"];
const ADDRESSES = ["#", "#t=7", "#t=1e9&filter=full,x", "#t=40&view=--camera+top+--zoom+3", "#t=3&view=--zoom+nan&pixels=recorded",
                   "#t=35&keys=30:wwdnnq.&select=node+7/7", "#t=2&keys=999:ww&ask={\"radius\":300,\"at\":[0,0,0]}",
                   "#t=12&select=point+3&view=--slice+z=100+--layers+none", "#t=9&ask=[&select=node+%00", "#%E0%A4%A"];
const FILES = [
    ["cut.json", '{"octreel": "session", "version": 2, "points": [[1, 2'],
    ["frame.png", "\x89PNG\r\n"],
    ["newer.json", '{"octreel": "session", "version": 3}'],
    ["three.json", '{"octreel": "session", "version": 2, "points": [[1, 2, 3], [40, 5, 6], [1, 2, 3]], "keys": "wwddnee"}'],
    ["nobody.json", '{"octreel": "session", "version": 2, "player": null, "points": {"sample": "uniform", "count": 300, "seed": 1}, ' +
                    '"velocities": {"speed": 90, "seed": 3}, "ticks": 40}\n{"tick": 4, "gap": "why"}\n{"tick": 9, "gap": "why not"}'],
    ["body.json", '{"octreel": "session", "version": 2, "player": {"id": 1, "body": true, "box_size": 90}, "points": ' +
                  '[{"id": 1, "position": [0, 0, 0], "velocity": [50, 60, 70]}], "keys": "wn", "ticks": 30}\n' +
                  '{"tick": 5, "edits": [{"remove": 1}, {"remove": 1}]}\n{"tick": 8, "edits": [{"insert": {"id": 1, "position": [1, 1, 1]}}]}'],
    ["default.json", byId("session").textContent],
];

const faults = new Map();
let inputs = 0, checks = 0;

Element.prototype.setPointerCapture = () => {}; /* synthetic events have no pointer to capture */
URL.createObjectURL = () => "#";

function find(what)
{
    faults.set(what, (faults.get(what) ?? 0) + 1);
}

const oneOf = list => list[random(list.length)];

function fire(target, event)
{
    inputs++;
    target.dispatchEvent(event);
}

/* ---- Inputs ------------------------------------------------------------------------------------------------- */

function point(type, target, x, y, more = {})
{
    const box = target.getBoundingClientRect();
    fire(target, new PointerEvent(type, {bubbles: true, pointerId: 1, isPrimary: true, buttons: type === "pointerup" ? 0 : 1,
                                         clientX: box.left + x * box.width, clientY: box.top + y * box.height, ...more}));
}

function drag(target)
{
    const more = oneOf([{}, {}, {shiftKey: true}, {buttons: 2, button: 2}, {pointerId: 2}]);
    point("pointerdown", target, random(100) / 100, random(100) / 100, more);
    for (let i = random(4); i > 0; i--)
        point("pointermove", target, random(100) / 100, random(100) / 100, more);
    if (random(20) > 0)
        point(oneOf(["pointerup", "pointerup", "pointercancel"]), target, random(100) / 100, random(100) / 100, more);
}

function click(target)
{
    const x = random(100) / 100, y = random(100) / 100;
    point("pointerdown", target, x, y);
    point("pointerup", target, x, y);
}

function change(control)
{
    if (control.type === "checkbox")
        control.checked = !control.checked;
    else
        control.value = control.options ? oneOf([...control.options]).value : oneOf(NASTY);
    fire(control, new Event("change", {bubbles: true}));
}

function drop([name, text])
{
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], name));
    fire(document.body, new DragEvent("drop", {bubbles: true, cancelable: true, dataTransfer}));
}

function ask()
{
    const form = byId("ask");
    if (form.elements.length > 0 && random(4) > 0)
        change(oneOf([...form.querySelectorAll("input, select")]));
    fire(form, new SubmitEvent("submit", {bubbles: true, cancelable: true}));
}

function scrub()
{
    byId("slider").value = random(octreel.last + 2);
    fire(byId("slider"), new Event("input", {bubbles: true}));
}

function type()
{
    byId("tick").value = oneOf(["-5", "7", "1e9", "x", String(random(300))]);
    fire(byId("tick"), new Event("change", {bubbles: true}));
}

const press = () => fire(document.body, new KeyboardEvent("keydown", {key: oneOf(KEYS_PRESSED), shiftKey: random(6) === 0,
                                                                      bubbles: true, cancelable: true}));

function wheel()
{
    fire(byId("stage"), new WheelEvent("wheel", {bubbles: true, cancelable: true, deltaY: random(400) - 200,
                                                 deltaMode: random(2), clientX: random(800), clientY: random(500)}));
}

function wheelOverLanes()
{
    fire(byId("scrub"), new WheelEvent("wheel", {bubbles: true, cancelable: true, deltaX: random(3) ? 0 : random(400) - 200,
                                                 deltaY: random(4000) - 2000, clientX: random(900)}));
}

function followLink()
{
    const links = [...document.querySelectorAll("[data-select], [data-go], [data-tick], .raw summary")];
    inputs++;
    if (links.length > 0)
        oneOf(links).click();
}

function clickButton()
{
    const buttons = [...document.querySelectorAll("button")].filter(button => !button.disabled);
    inputs++;
    oneOf(buttons).click();
}

/* The inputs, and how often each is made. */
const ACTS = [
    [30, press], [20, () => drag(byId("stage"))], [12, () => click(byId("stage"))], [12, wheel], [10, scrub],
    [6, () => drag(byId("scrub"))], [2, () => { location.hash = oneOf(ADDRESSES); }], [3, type], [4, wheelOverLanes],
    [6, followLink], [1, () => drag(byId("range"))], [5, clickButton], [6, ask], [1, () => drop(oneOf(FILES))],
    [8, () => {
        const controls = [...byId("view-rows").querySelectorAll("input, select")];
        if (controls.length > 0)
            change(oneOf(controls));
    }],
];
const TIMES = ACTS.flatMap(([times, act]) => Array(times).fill(act));

/* ---- Checks ------------------------------------------------------------------------------------------------- */

const withoutFrame = text => {
    const {frame, scene, ...facts} = JSON.parse(text);
    return JSON.stringify(facts);
};

async function settle()
{
    for (let i = 0; i < 3; i++) {
        octreel.pause();
        await interaction.pressed;
        await interaction.starting;
        await interaction.opening;
        await octreel.address.opening;
        await until(() => !interaction.busy, "the picture that is shown");
    }
}

/* Compare the shown tick with the same tick, played from the beginning. */
async function check()
{
    await settle();
    checks++;
    const status = byId("status").textContent;
    if (/undefined|is not (a function|defined|iterable)|unreachable|out of|RangeError|detached/.test(status))
        find(`status: ${status}`);
    if (!interaction.isLive)
        return;
    const {engine} = player(), {tick, view} = engine, fresh = new Engine(interaction.module);
    if (tick !== octreel.tick)
        find(`shows tick ${tick < octreel.tick ? "before" : "after"} that of the page`);
    player().replay();
    fresh.open(player().save(), view);
    while (fresh.tick < tick)
        fresh.step();
    if (fresh.facts() !== engine.facts())
        find(`wrong facts: ${engine.facts().slice(0, 200)} and not ${fresh.facts().slice(0, 200)}`);
    const recorded = JSON.stringify(octreel.recording.tick(tick));
    if (withoutFrame(recorded) !== withoutFrame(engine.facts()))
        find(`the recording has other facts: ${recorded.slice(0, 200)} and not ${engine.facts().slice(0, 200)}`);
    const shown = digestOf(engine.draw().data), scene = engine.digest();
    if (shown !== digestOf(fresh.draw().data) || scene !== fresh.digest())
        find(`wrong picture (${scene === fresh.digest() ? "of the same scene" : "of another scene"}): ${JSON.stringify(view)}`);
}

run(async () => {
    seed = given.seed;
    while (inputs < given.inputs && faults.size < MOST_FINDINGS) {
        const next = inputs + INPUTS_A_CHECK;
        while (inputs < next) {
            oneOf(TIMES)();
            if (random(3) === 0)
                await new Promise(done => setTimeout(done, random(20) === 0 ? 5 : 0));
        }
        await check();
    }
    for (const message of errors.splice(0))
        find(`exception: ${message.stack ?? message}`);
    say("inputs", inputs);
    say("checks", checks);
    say("findings", faults.size);
    for (const [what, times] of faults)
        say(`finding ${times}`, what.replaceAll("\n", " "));
});
