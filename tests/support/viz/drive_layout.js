/* SPDX-License-Identifier: MIT */
/* drive_layout.js - uses the parts around the picture of a recording's page: the column of text, the sheets, recorded
 * pixels, and addresses. Reports lines "name<tab>value". */
"use strict";

Element.prototype.setPointerCapture = () => {}; /* synthetic events have no pointer to capture */

const press = key => document.body.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
const canvas = () => byId("stage").querySelector("canvas.live");
const settled = () => until(() => !interaction.busy && !interaction.live?.waiting, "the picture");

async function goTo(tick)
{
    octreel.goTo(tick);
    await settled();
}

/* Whether the picture has a pixel for each pixel of the stage. */
function fills()
{
    const {clientWidth, clientHeight} = byId("stage");
    return canvas()?.width === Math.round(clientWidth * devicePixelRatio) &&
        canvas().height === Math.round(clientHeight * devicePixelRatio);
}

async function sayColumn()
{
    const before = byId("stage").clientWidth;
    say("fills", fills());
    say("title", byId("column").querySelector("h2").textContent);
    say("caption", byId("words").checkVisibility() ? byId("words").textContent : "");
    say("row", [...byId("column").querySelectorAll(".row")].some(row => row.textContent === "leaf capacity2"));
    say("symbols", byId("column").querySelectorAll("svg path").length > 5);
    press("o");
    await until(fills, "a wider picture");
    say("wider without the column", byId("stage").clientWidth > before);
    press("o");
    await until(fills, "the picture as before");
}

/* Report the shown pixels in the mode of recorded pixels. */
async function sayExact()
{
    press("p");
    await until(() => byId("stage").querySelector("img"), "the frame");
    say("frame", byId("stage").querySelector("img").getAttribute("src"));
    interaction.live.drawNow();
    const {width, height} = canvas();
    say("exact", digestOf(canvas().getContext("2d").getImageData(0, 0, width, height).data));
    press("p");
    await until(fills, "the window's picture");
}

function point(type, id, x, y)
{
    const box = byId("stage").getBoundingClientRect();
    byId("stage").dispatchEvent(new PointerEvent(type, {bubbles: true, pointerId: id, pointerType: "touch", clientX: box.left + x,
                                                        clientY: box.top + y, buttons: type === "pointerup" ? 0 : 1}));
}

/* A tap opens the sheet, Esc closes it; a finger turns, two fingers zoom. */
async function sayTouch()
{
    say("sheet before", isOpen("sheet"));
    point("pointerdown", 1, 60, 80);
    await settled();
    point("pointerup", 1, 60, 80);
    say("sheet after a tap", isOpen("sheet"));
    press("Escape");
    say("sheet after Esc", isOpen("sheet"));
    press("i");
    press("v");
    say("one sheet at a time", `${isOpen("sheet")} ${isOpen("tools")}`);
    press("Escape");
    point("pointerdown", 1, 100, 100);
    await settled();
    point("pointermove", 1, 160, 100);
    say("a finger turns", "look" in player().engine.view);
    point("pointerdown", 2, 200, 200);
    await settled();
    point("pointermove", 2, 300, 300);
    say("two fingers zoom", player().engine.view.zoom > 1.2);
    point("pointerup", 1, 160, 100);
    point("pointerup", 2, 300, 300);
    interaction.goBack();
    await settled();
}

/* If a moving view is slow with half of the pixels of an axis, it loses more of them, and gets them back. The first
 * picture has all pixels. */
function sayCoarser()
{
    const scales = [], now = performance.now;
    for (const ms of [100, 100, 100, 1, 100, 100, 100, 100, 1, 1, 1]) {
        performance.now = () => clock += ms;
        point("pointermove", 1, 170 + scales.length, 100);
        scales.push(interaction.live.coarse.toFixed(2));
    }
    performance.now = now;
    say("coarser while it is slow", scales.join(" "));
}

/* A view that moves has fewer pixels if a picture takes long, until it rests. */
async function sayCoarse()
{
    const {live} = interaction, {width} = canvas();
    point("pointerdown", 1, 100, 100);
    await settled();
    live.cost = 1000;
    point("pointermove", 1, 160, 100);
    say("coarse while it moves", Math.abs(canvas().width - width / 2) <= 1);
    await until(fills, "all pixels");
    sayCoarser();
    await until(fills, "all pixels");
    live.cost = 0;
    point("pointermove", 1, 200, 100);
    say("all pixels if they are fast", fills());
    point("pointerup", 1, 200, 100);
    interaction.goBack();
    await settled();
}

function sayHelp()
{
    press("?");
    say("help begins", `${byId("help").scrollTop} ${document.activeElement.id}`);
    byId("help").close();
}

function sayNames()
{
    const isNamed = control => control.ariaLabel || control.textContent.trim() || control.labels?.length > 0;
    const controls = [...document.querySelectorAll("button, input, select, [role=img]")];
    say("without a name", controls.filter(control => !isNamed(control)).map(({id, outerHTML}) => id || outerHTML).join(" "));
    say("beyond the keyboard", document.querySelectorAll('button[tabindex="-1"], input[tabindex="-1"]').length);
}

/* ---- Addresses -------------------------------------------------------------------------------------------------- */

async function open(hash)
{
    let opened = false;
    addEventListener("hashchange", () => setTimeout(() => opened = true), {once: true});
    location.hash = hash;
    await until(() => opened, "the address");
    await until(() => !octreel.address.opening, "what the address holds");
    await settled();
}

const shown = () => `${octreel.tick} ${player().engine.digest()} ${octreel.inspector.name} ${interaction.branchText} ` +
    `${player().engine.facts()}`;

async function sayLink()
{
    await goTo(41);
    await interaction.live.look({camera: "top", zoom: 2.5, slice: {z: 100}, layers: ["points", "nodes"]});
    await octreel.inspector.select("node 7/7");
    octreel.address.write();
    say("link", location.hash);
    const saw = shown(), link = location.hash;
    press("Escape");
    await open("#t=3");
    say("without the view", `${octreel.tick} ${interaction.changedOptions()}${octreel.inspector.name}`);
    await open(link);
    say("link opens the same", shown() === saw);
}

async function sayPlayedLink()
{
    await open("#t=30");
    for (const key of "wwdnn")
        await interaction.press(key);
    await settled();
    await interaction.ask({radius: 300, at: [0, 0, 0]});
    octreel.address.write();
    say("played link", decodeURIComponent(location.hash));
    const saw = shown(), link = location.hash;
    await open("#t=3");
    say("as recorded again", `${interaction.branchText}${octreel.last} ${player().engine.tick}`);
    await open(link);
    say("played link opens the same", shown() === saw);
    await open("#t=0");
}

const WRONG = ["t=x", "t=-1", "t=1e3", "t=0&filter=boo", "t=0&view=--camera+moon", "t=0&view=rm", "t=0&view=--look",
               "t=0&view=--slice+w", "t=0&view=--zoom+nan", "t=0&view=--region+1", "t=0&view=--layers+%3Cb%3E",
               "t=0&view=--__proto__+1", "t=0&view=--depths", "t=0&view=--depths+:", "t=0&view=--depths+1:2:3",
               "t=0&view=--depths+0x2", "t=0&view=--depths+3:2", "t=0&view=--depths+22", "t=0&view=--slice+z=",
               "t=0&view=--look+30,", "t=0&keys=w", "t=0&keys=3:xyz", "t=0&ask={", "t=0&select=node",
               "t=0&select=node+9/9", "t=0&select=point+99999999999999999999999", "t=0&select=%00", "t=0&select=constructor+x"];

const DEPTHS = ["2:5", "2:", ":5", "2", "02:"];

/* Report the member of the view that each text of --depths gives. */
function sayDepths()
{
    for (const text of DEPTHS)
        say(`depths ${text}`, JSON.stringify(viewOf(`--depths ${text}`, {}).depths));
}

/* Report the addresses after which the page shows another view than the recorded one, or no sentence. */
async function sayWrong()
{
    for (const address of WRONG) {
        await open("#t=1");
        interaction.showStatus("");
        await open(`#${address}`);
        const status = byId("status").textContent, changed = interaction.changedOptions(true);
        say(`wrong ${address}`, `${octreel.tick} ${changed}${octreel.inspector.name ?? ""}${status.slice(0, 43)}`);
    }
    await open("#t=0&ask=5");
    say("no query", byId("status").textContent);
}

async function sayCopied()
{
    let copied = "";
    Object.defineProperty(navigator, "clipboard", {value: {writeText: async text => { copied = text; }}});
    press("l");
    await until(() => copied, "the link");
    say("copied", copied === location.href);
}

run(async () => {
    await interaction.start();
    await goTo(41);
    await sayColumn();
    await sayExact();
    await sayTouch();
    await sayCoarse();
    sayHelp();
    sayNames();
    await sayLink();
    await sayPlayedLink();
    sayDepths();
    await sayWrong();
    await sayCopied();
});
