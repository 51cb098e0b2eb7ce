/* SPDX-License-Identifier: MIT */
/* report.js - which frame is looked at and how, the keys that change that, and what is said beside it. The place is in
 * the address: #frame=frame_000041.png&mode=blink. */
"use strict";

const ADDRESS_DELAY = 200; /* ms: browsers refuse an address that changes too often */
const SWIPE_STEP = 2; /* percent */
const ZOOM_STEP = 1.5;

/* Ways to look: their keys, and what they are. */
const MODES = [
    ["swipe", "s", "swipe", "expected on the left of the line, actual on its right"],
    ["blink", "b", "blink", "one after the other"],
    ["difference", "d", "difference", "what differs glows"],
    ["side", "t", "side by side", "all three together"],
    ["expected", "e", "expected", "the reference alone"],
    ["actual", "a", "actual", "the frame alone"],
];

const byId = id => document.getElementById(id);

function element(name, text, attributes = {})
{
    const made = document.createElement(name);
    made.append(text);
    for (const [attribute, value] of Object.entries(attributes))
        made.setAttribute(attribute, value);
    return made;
}

class Report {
    constructor(findings)
    {
        this.findings = findings;
        this.last = findings.frames.length - 1;
        this.frame = -1;
        this.stage = new Stage(byId("stage"));
        this.stage.onchange = () => this.showStage();
        this.curve = new Curve(byId("curve"), findings, frame => this.goTo(frame));
        this.ticks = new Ticks(findings);
    }

    /* ---- Where to ------------------------------------------------------------------------------------------- */

    goTo(frame)
    {
        const next = clamp(frame, 0, this.last);
        if (next === this.frame)
            return;
        this.frame = next;
        this.show();
        this.writeAddressSoon();
    }

    step(frames)
    {
        this.goTo(this.frame + frames);
    }

    look(mode)
    {
        this.stage.look(mode);
        this.writeAddressSoon();
    }

    /* ---- What is seen --------------------------------------------------------------------------------------- */

    show()
    {
        const finding = this.findings.frames[this.frame];
        for (const entry of byId("list").children)
            entry.lastChild.removeAttribute("aria-current");
        const entry = byId("list").children[this.frame].lastChild;
        entry.setAttribute("aria-current", "true");
        entry.scrollIntoView({block: "nearest", inline: "nearest"});
        byId("place").textContent = `${this.frame + 1} of ${this.last + 1}`;
        document.querySelector('[data-key="p"]').disabled = this.frame === 0;
        document.querySelector('[data-key="n"]').disabled = this.frame === this.last;
        this.curve.show(this.frame);
        this.showPanel(finding);
        this.showPictures(finding);
        byId("spoken").textContent = `${shortName(finding)}: ${headlineOf(finding)}`;
    }

    showPanel(finding)
    {
        byId("frame").textContent = finding.frame;
        byId("cause").textContent = headlineOf(finding);
        byId("details").textContent = detailsOf(finding);
        byId("details").hidden = detailsOf(finding) === "";
        byId("colors").hidden = !finding.files.difference;
        byId("facts-of-frame").replaceChildren();
        for (const [name, value] of factsOf(finding))
            byId("facts-of-frame").append(element("dt", name), element("dd", value, {"data-fact": name}));
        this.showFiles(finding);
    }

    /* Links to what lies beside the page, where it was taken along. */
    showFiles(finding)
    {
        const links = Object.entries(finding.files).map(([word, file]) =>
            element("a", word, {href: file.split("/").map(encodeURIComponent).join("/"), title: file}));
        if (links.length === 0)
            return;
        const value = element("dd", "", {"data-fact": "files"});
        value.append(...links);
        byId("facts-of-frame").append(element("dt", "files"), value);
    }

    async showPictures(finding)
    {
        const addresses = {}, tally = tallyOf(finding), frame = this.frame;
        for (const name of PICTURES) {
            const address = this.findings.picture(frame, name);
            if (address)
                addresses[name] = address;
        }
        const place = tally.pixels > 0 ? {worst: tally.worst_at, min: tally.min, max: tally.max} : null;
        await this.stage.show(addresses, place);
        if (frame !== this.frame)
            return;
        byId("nothing").hidden = Object.keys(addresses).length > 0;
        byId("nothing").textContent = this.whyNothing(finding);
        this.showStage();
        document.body.dataset.frame = finding.frame; /* all of it is seen */
    }

    whyNothing(finding)
    {
        if (finding.finding === "unreadable")
            return "It cannot be read, so there is no picture of it.";
        if (finding.embedded)
            return "There is no picture of it.";
        return "Its pictures are too large for this page. They lie beside it.";
    }

    showStage()
    {
        const {seen, zoom} = this.stage;
        for (const button of byId("modes").children) {
            const mode = button.dataset.mode;
            button.setAttribute("aria-pressed", mode === seen);
            button.disabled = !this.stage.can(mode);
        }
        for (const button of byId("zooms").querySelectorAll("button"))
            button.disabled = !seen || (button.dataset.key === "z" && !this.stage.place);
        document.querySelector('[data-key="z"]').setAttribute("aria-pressed", Boolean(zoom?.worst));
        document.querySelector('[data-key="0"]').setAttribute("aria-pressed", zoom === null);
        byId("scale").textContent = seen ? `${Math.round(100 * this.stage.scale())}%` : "";
    }

    /* ---- The address ---------------------------------------------------------------------------------------- */

    readAddress()
    {
        const address = new URLSearchParams(location.hash.slice(1)), mode = address.get("mode");
        if (Object.hasOwn(PANES, mode))
            this.stage.look(mode);
        this.goTo(Math.max(this.findings.indexOf(address.get("frame")), 0));
    }

    writeAddressSoon()
    {
        clearTimeout(this.writing);
        this.writing = setTimeout(() => {
            const frame = encodeURIComponent(this.findings.frames[this.frame].frame);
            history.replaceState(null, "", `#frame=${frame}&mode=${this.stage.mode}`);
        }, ADDRESS_DELAY);
    }
}

/* ---- Keys and buttons --------------------------------------------------------------------------------------- */

/* Keys as KeyboardEvent names them, as people read them, what they do in words, and what they do. */
const KEYS = [
    [["n", "ArrowRight", "ArrowDown"], "n →", "next difference", report => report.step(1)],
    [["p", "ArrowLeft", "ArrowUp"], "p ←", "previous difference", report => report.step(-1)],
    [["Home"], "Home", "first difference", report => report.step(-Infinity)],
    [["End"], "End", "last difference", report => report.step(Infinity)],
    ...MODES.map(([mode, key, name, words]) => [[key], key, `${name}: ${words}`, report => report.look(mode)]),
    [[" "], "space", "blink by hand", report => report.stage.can("blink") && report.stage.flipByHand()],
    [["["], "[", "swipe to the left", report => report.stage.swipe(report.stage.swiped - SWIPE_STEP)],
    [["]"], "]", "swipe to the right", report => report.stage.swipe(report.stage.swiped + SWIPE_STEP)],
    [["z"], "z", "the worst place, and back", report => report.stage.seen && report.stage.zoomToWorst()],
    [["+", "="], "+", "larger", report => report.stage.seen && report.stage.zoomBy(ZOOM_STEP)],
    [["-"], "-", "smaller", report => report.stage.seen && report.stage.zoomBy(1 / ZOOM_STEP)],
    [["0"], "0", "the whole picture", report => report.stage.seen && report.stage.zoomTo(0)],
    [["x"], "x", "tick it, to be accepted, or not", report => report.ticks.toggle(report.frame)],
    [["m"], "m", "marks of the worst place and of all that differs, on or off", report => report.stage.toggleMarks()],
    [["?"], "?", "these keys", () => byId("help").showModal()],
];

function actionOf(key)
{
    return KEYS.find(([names]) => names.includes(key))?.[3];
}

/* What the focused control would do with the key by itself goes before. */
function isTaken(event)
{
    const control = event.target.closest?.("button, a, input");
    return event.ctrlKey || event.altKey || event.metaKey || byId("help").open ||
        (control && [" ", "Enter"].includes(event.key));
}

function swipeByKey(event, stage)
{
    const direction = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (!direction)
        return;
    event.preventDefault();
    event.stopPropagation();
    stage.swipe(stage.swiped + direction * SWIPE_STEP);
}

function listen(report)
{
    document.addEventListener("keydown", event => {
        const action = actionOf(event.key);
        if (!action || isTaken(event))
            return;
        event.preventDefault();
        action(report);
    });
    byId("handle").addEventListener("keydown", event => swipeByKey(event, report.stage));
    for (const button of document.querySelectorAll("[data-key]"))
        button.addEventListener("click", () => actionOf(button.dataset.key)(report));
    /* After a click the space bar is for blinking, and not for the button that was clicked. */
    document.addEventListener("click", event => event.detail > 0 && event.target.closest("button")?.blur());
    byId("help-open").addEventListener("click", () => byId("help").showModal());
    addEventListener("hashchange", () => report.readAddress());
}

/* ---- The page ----------------------------------------------------------------------------------------------- */

function describe({whole, frames})
{
    const words = whole.verdict_words, colon = words.indexOf(": ");
    byId("verdict").textContent = capital(words.slice(0, colon));
    byId("verdict").dataset.verdict = whole.verdict;
    byId("about").append(element("strong", whole.compared.path), " against ", element("strong", whole.reference.path),
                         ` · ${words.slice(colon + 2)} · ${whole.tolerance_words}`);
    byId("headline").textContent = frames.length > 0 ? headlineOfAll(whole, frames) : "";
    byId("headline").hidden = frames.length === 0;
    byId("trouble").textContent = `Nobody can say why: ${whole.trouble}`;
    byId("trouble").hidden = !whole.trouble;
    document.title = `${whole.verdict}: ${whole.compared.path} – octreel diff`;
}

function fillList(findings, boxes, goTo)
{
    findings.frames.forEach((finding, i) => {
        const button = element("button", element("span", shortName(finding), {class: "name"}),
                               {type: "button", title: titleOf(finding), "data-finding": finding.finding});
        if (finding.frames.length > 1)
            button.append(element("b", `+${grouped(finding.frames.length - 1)}`));
        button.append(element("small", shortWords(finding)));
        button.addEventListener("click", () => goTo(i));
        const entry = element("li", boxes[i]);
        entry.append(button);
        byId("list").append(entry);
    });
    const {left_out: leftOut} = findings.whole, kept = findings.frames.length;
    byId("left-out").hidden = leftOut === 0;
    byId("left-out").textContent = `${grouped(leftOut)} more ${leftOut === 1 ? "finding" : "findings"}: ` +
        `this page has the first ${kept}. The pictures of all lie beside it.`;
}

function fillControls(look)
{
    for (const [mode, key, name] of MODES) {
        const button = element("button", name, {type: "button", "data-mode": mode, title: `${name} (${key})`});
        button.addEventListener("click", () => look(mode));
        byId("modes").append(button);
    }
    for (const [, shown, words] of KEYS) {
        const row = element("tr", element("td", "")), keys = shown.split(" ").map(key => element("kbd", key));
        row.firstChild.append(...keys);
        row.append(element("td", words));
        byId("help-keys").append(row);
    }
}

function showCalm(whole)
{
    const forgiven = whole.found.within_tolerance;
    const words = `${grouped(forgiven)} ${forgiven === 1 ? "frame differs and is" : "frames differ and are"} forgiven`;
    byId("calm").hidden = false;
    byId("calm").querySelector("h2").textContent = forgiven > 0 ? words : "No frame differs";
    byId("calm-words").textContent = whole.verdict_words.replace(/^.*?: /, "");
    byId("calm-tolerance").textContent = capital(whole.tolerance_words);
}

function openReport()
{
    const findings = new Findings(byId("facts").textContent);
    describe(findings);
    fillControls(mode => report.look(mode));
    if (findings.frames.length === 0) {
        showCalm(findings.whole);
        byId("help-open").hidden = true;
        return;
    }
    byId("report").hidden = false;
    const report = new Report(findings);
    fillList(findings, report.ticks.boxes, frame => report.goTo(frame));
    listen(report);
    report.readAddress();
}

openReport();
