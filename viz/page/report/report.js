/* SPDX-License-Identifier: MIT */
/* report.js - the report page: the current finding, the way its pictures are compared, and the facts beside them. The
 * page's address holds the frame and the mode: #frame=frame_000041.png&mode=blink. */
"use strict";

/* Milliseconds between two changes of the page's address: browsers refuse an address that changes too often. */
const ADDRESS_DELAY = 200;
const SWIPE_STEP = 2; /* percent of the stage by which a key moves the line between the pictures */
const ZOOM_STEP = 1.5;

/* The ways to compare two pictures. Each row has the mode, its key, its name and its help text. */
const MODES = [
    ["swipe", "s", "swipe", "expected on the left of the line, actual on its right"],
    ["blink", "b", "blink", "expected and actual in turn"],
    ["difference", "d", "difference", "pixels that differ glow"],
    ["flip", "f", "FLIP", "how visible the differences are, from black to pale yellow"],
    ["side", "t", "side by side", "expected, actual and difference"],
    ["expected", "e", "expected", "only the reference"],
    ["actual", "c", "actual", "only the compared frame"],
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
        this.hasFlip = findings.frames.some(finding => finding.files.flip);
        this.frame = -1;
        this.stage = new Stage(byId("stage"));
        this.stage.onchange = () => this.showStage();
        this.curve = new Curve(byId("curve"), findings, frame => this.goTo(frame));
        this.selection = new Selection(findings);
    }

    /* ---- Going to a frame ----------------------------------------------------------------------------------- */

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

    /* ---- What is shown --------------------------------------------------------------------------------------- */

    show()
    {
        const finding = this.findings.frames[this.frame];
        this.entry?.removeAttribute("aria-current");
        this.entry = byId("list").children[this.frame].lastChild;
        this.entry.setAttribute("aria-current", "true");
        this.entry.scrollIntoView({block: "nearest", inline: "nearest"});
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
        byId("flip-colors").hidden = !finding.files.flip;
        byId("facts-of-frame").replaceChildren();
        for (const [name, value] of factsOf(finding))
            byId("facts-of-frame").append(element("dt", name), element("dd", value, {"data-fact": name}));
        this.showFiles(finding);
        this.showPages(finding);
    }

    /* Show links to the pages of the recordings, at the tick of the finding and with the point that its cause names. */
    showPages({tick, point})
    {
        const pages = Object.entries(this.findings.whole.recordings);
        if (tick === undefined || pages.length === 0)
            return;
        const value = element("dd", "", {"data-fact": "play"}), select = point === undefined ? "" : `&select=point+${point}`;
        value.append(...pages.map(([word, folder]) => {
            const path = folder.split("/").map(encodeURIComponent).join("/");
            return element("a", word, {href: `${path}index.html#t=${tick}${select}`, title: "Play this recording from this tick"});
        }));
        byId("facts-of-frame").append(element("dt", "play"), value);
    }

    /* Show links to the picture files in the folder of the page. */
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
        /* Set after everything is shown: the browser tests wait for this attribute. */
        document.body.dataset.frame = finding.frame;
    }

    whyNothing(finding)
    {
        if (finding.finding === "unreadable")
            return "This frame cannot be read, so it has no picture.";
        if (finding.embedded)
            return "This frame has no picture.";
        return "The pictures are too large for this page; they are files beside it.";
    }

    showStage()
    {
        const {seen, zoom} = this.stage;
        for (const button of byId("modes").children) {
            const mode = button.dataset.mode;
            button.setAttribute("aria-pressed", mode === seen);
            button.disabled = !this.stage.can(mode);
            button.hidden = mode === "flip" && !this.hasFlip;
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

/* The keys of the page. Each row has the key's names in KeyboardEvent, its name in the help, its help text, and its
 * action. */
const KEYS = [
    [["j", "n", "ArrowRight", "ArrowDown"], "j n →", "next difference", report => report.step(1)],
    [["k", "p", "ArrowLeft", "ArrowUp"], "k p ←", "previous difference", report => report.step(-1)],
    [["Home"], "Home", "first difference", report => report.step(-Infinity)],
    [["End"], "End", "last difference", report => report.step(Infinity)],
    ...MODES.map(([mode, key, name, words]) => [[key], key, `${name}: ${words}`, report => report.look(mode)]),
    [[" "], "space", "blink by hand: show the other picture",
     report => report.stage.can("blink") && report.stage.flipByHand()],
    [["["], "[", "swipe to the left", report => report.stage.swipe(report.stage.swiped - SWIPE_STEP)],
    [["]"], "]", "swipe to the right", report => report.stage.swipe(report.stage.swiped + SWIPE_STEP)],
    [["z"], "z", "zoom to the worst pixel, or back", report => report.stage.seen && report.stage.zoomToWorst()],
    [["+", "="], "+", "zoom in", report => report.stage.seen && report.stage.zoomBy(ZOOM_STEP)],
    [["-"], "-", "zoom out", report => report.stage.seen && report.stage.zoomBy(1 / ZOOM_STEP)],
    [["0"], "0", "the whole picture", report => report.stage.seen && report.stage.zoomTo(0)],
    [["a", "x"], "a x", "select or deselect the finding for acceptance", report => report.selection.toggle(report.frame)],
    [["m"], "m", "show or hide the marks of the worst pixel and of all differences",
     report => report.stage.toggleMarks()],
    [["?"], "?", "show these keys", () => byId("help").showModal()],
];

function actionOf(key)
{
    return KEYS.find(([names]) => names.includes(key))?.[3];
}

/* Whether the focused control handles the pressed key itself. */
function isHandled(event)
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
        if (!action || isHandled(event))
            return;
        event.preventDefault();
        action(report);
    });
    byId("handle").addEventListener("keydown", event => swipeByKey(event, report.stage));
    for (const button of document.querySelectorAll("[data-key]"))
        button.addEventListener("click", () => actionOf(button.dataset.key)(report));
    /* Take the focus from a clicked button. Otherwise the space bar would press the button again, instead of
     * blinking. */
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
    byId("trouble").textContent = `The cause is unknown: ${whole.trouble}`;
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
        `this page shows the first ${grouped(kept)}. The pictures of all findings are files beside it.`;
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
    fillList(findings, report.selection.boxes, frame => report.goTo(frame));
    listen(report);
    report.readAddress();
}

openReport();
