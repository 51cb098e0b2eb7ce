/* SPDX-License-Identifier: MIT */
/* drive_hostile.js - opens damaged pages (`given`: names and texts), each in a frame, and uses the controls that they
 * have. */
"use strict";

/* A script before a page: it replaces what does not work in a frame, removes features, and makes parts of the page
 * visible to this script. Behind the page's security policy it would not run. */
const BEFORE = "<script>var faults = []; history.replaceState = () => {}; requestAnimationFrame = setTimeout;" +
    "addEventListener('error', event => faults.push(event.message)); var viewer = () => octreel; MORE<\/script>";

const isShown = element => element !== null && !element.closest("[hidden]");

async function open(text, more)
{
    const frame = document.createElement("iframe");
    frame.width = 900; /* wide enough for the column of text */
    frame.srcdoc = BEFORE.replace("MORE", () => more) + text;
    const loaded = new Promise(done => frame.addEventListener("load", done));
    document.body.append(frame);
    await loaded;
    for (let i = 0; i < 50 && !isShown(frame.contentDocument.getElementById("viewer")); i++)
        await new Promise(done => setTimeout(done, 10));
    return frame.contentWindow;
}

async function sayPage({name, text, more = ""})
{
    const page = await open(text, more), byId = id => page.document.getElementById(id);
    const message = byId("message");
    say(`${name}: message`, isShown(message) ? message.textContent.replace(/\s+/g, " ").trim() : "");
    say(`${name}: faults`, page.faults.join(" "));
    if (isShown(message))
        return;
    say(`${name}: bar`, isShown(byId("live-bar")));
    page.document.body.dispatchEvent(new page.KeyboardEvent("keydown", {key: "ArrowRight", bubbles: true}));
    page.document.body.dispatchEvent(new page.KeyboardEvent("keydown", {key: "w", bubbles: true}));
    const {interaction} = page.viewer();
    await interaction.pressed;
    say(`${name}: after a key`, `tick ${page.document.body.dataset.tick} of ${page.viewer().last}` +
                                `${interaction.isLive ? ", played" : ""}: ${byId("status").textContent}`);
    say(`${name}: column`, isShown(byId("column")));
    say(`${name}: keys`, [...byId("help").querySelectorAll("kbd")].some(({textContent}) => textContent === "w"));
}

run(async () => {
    for (const one of given)
        await sayPage(one);
});
