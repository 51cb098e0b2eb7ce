/* SPDX-License-Identifier: MIT */
/* page.js - the viewer: the current tick, playing, the event filter, keys and buttons. */
"use strict";

const SPEEDS = [1, 2, 5, 10, 15, 30, 60]; /* frames per second */
const START_SPEED = 15;
const FRAMES_AHEAD = 6;
const SHORTEST_WAIT = 4; /* the shortest wait between two frames in ms */
const GROWTH_DELAY = 250; /* ms between two drawings of a timeline that grows while ticks are added */

const NO_FRAMES = "This recording has no frames.";
const NO_MODULE = "This recording has no frames, and this page cannot draw them: octreel was built without " +
    "WebAssembly. To get frames, run octreel record session.json.";
const NO_BROWSER = "This recording has no frames, and this browser lacks WebAssembly to draw them. Use a newer " +
    "browser, or run octreel record session.json.";

const byId = id => document.getElementById(id);

class Viewer {
    constructor(recording)
    {
        this.recording = recording;
        this.tick = 0;
        this.filter = 0; /* the selected events as bits; 0: no filter */
        this.playing = false;
        this.stage = new Frames(byId("stage"), tick => recording.tick(tick).frame);
        /* The promise of the first picture, or of the reason why the page cannot draw it. */
        const begun = new Promise(done => this.begins = done);
        this.timeline = new Timeline(recording, begun, {goTo: tick => this.goTo(tick), toggle: bit => this.toggle(bit)});
        this.inspector = new Inspector(this);
        this.interaction = new Interaction(this);
        this.address = new Address(this);
    }

    get last()
    {
        return this.recording.length - 1;
    }

    get page()
    {
        return Math.max(10, Math.round(this.recording.length / 20));
    }

    /* Show another recording, or the same recording after ticks were added to it. */
    follow(recording)
    {
        const other = recording !== this.recording;
        this.recording = recording;
        this.tick = Math.min(this.tick, this.last);
        byId("slider").max = byId("tick").max = byId("last").textContent = this.last;
        if (other)
            this.timeline.show(recording);
        else if (this.timeline.scale.last !== this.last)
            this.growing ??= setTimeout(() => {
                this.growing = undefined;
                this.timeline.show(this.recording);
            }, GROWTH_DELAY);
    }

    /* ---- Going to a tick ------------------------------------------------------------------------------------ */

    goTo(tick)
    {
        this.tick = Math.min(Math.max(tick, 0), this.last);
        this.show();
    }

    step(ticks)
    {
        this.pause();
        this.goTo(this.tick + ticks);
    }

    /* The nearest tick in a direction for which wanted(tick) is true. Returns -1 if there is no such tick. */
    seek(from, direction, wanted)
    {
        for (let i = from + direction; i >= 0 && i <= this.last; i += direction)
            if (wanted(i))
                return i;
        return -1;
    }

    /* Whether a tick matches the event filter. Without a filter, a tick matches if it has any event except "moved",
     * which most ticks have. */
    matches(tick)
    {
        return (this.recording.events[tick] & (this.filter || ~MOVED)) !== 0;
    }

    seekMatch(direction)
    {
        const found = this.seek(this.tick, direction, tick => this.matches(tick));
        this.pause();
        if (found >= 0)
            this.goTo(found);
    }

    toggle(bit)
    {
        this.filter ^= bit;
        this.show();
    }

    foldTimeline(folded)
    {
        foldTimeline(folded);
        this.timeline.draw();
    }

    showExact(exact)
    {
        this.interaction.showExact(exact);
        this.show();
    }

    clearFilter()
    {
        this.filter = 0;
        this.show();
    }

    /* ---- Playing -------------------------------------------------------------------------------------------- */

    /* Whether playing shows a tick. With a filter, playing shows the ticks that match it. Without a filter, it shows
     * the ticks that have a picture. */
    isPlayed(tick)
    {
        return this.filter ? this.matches(tick) : this.interaction.isLive || this.recording.hasFrame(tick);
    }

    nextPlayed(from)
    {
        return this.seek(from, 1, tick => this.isPlayed(tick));
    }

    play()
    {
        if (this.nextPlayed(this.tick) < 0)
            this.goTo(Math.max(this.nextPlayed(-1), 0));
        this.playing = true;
        this.due = performance.now();
        this.showPlaying();
        this.playDueFrame();
    }

    pause()
    {
        this.playing = false;
        clearTimeout(this.timer);
        this.showPlaying();
    }

    /* Show the next frame when it is due. A frame that is still being decoded is waited for, so that playing skips no
     * frame. */
    playDueFrame()
    {
        const now = performance.now();
        if (now >= this.due && !this.stage.busy && !this.interaction.busy) {
            this.due = Math.max(this.due + 1000 / Number(byId("speed").value), now);
            this.playNext();
        }
        if (this.playing)
            this.timer = setTimeout(() => this.playDueFrame(), Math.max(this.due - now, SHORTEST_WAIT));
    }

    playNext()
    {
        const next = this.nextPlayed(this.tick);
        if (next >= 0)
            this.goTo(next);
        if (this.nextPlayed(this.tick) < 0)
            this.pause();
    }

    changeSpeed(direction)
    {
        const select = byId("speed");
        select.selectedIndex = Math.min(Math.max(select.selectedIndex + direction, 0), SPEEDS.length - 1);
    }

    /* ---- What is seen --------------------------------------------------------------------------------------- */

    show()
    {
        const tick = this.recording.tick(this.tick);
        byId("slider").value = byId("tick").value = this.tick;
        byId("slider").setAttribute("aria-valuetext", `tick ${this.tick} of ${this.last}`);
        document.body.dataset.tick = this.tick;
        this.inspector.show(tick);
        this.timeline.mark(this.tick);
        this.showFrame();
        this.showFilter();
        if (!this.playing)
            byId("spoken").textContent = `Tick ${this.tick}: ${(tick.events ?? []).join(", ") || "no events"}`;
        this.address.writeSoon();
    }

    showFrame()
    {
        const {interaction} = this;
        if (interaction.isLive)
            interaction.show(this.tick);
        if (!interaction.showsFrames) {
            byId("caption").hidden = true;
            byId("stage").classList.remove("stale");
            return;
        }
        if (!this.recording.hasFrames) {
            this.drawOrExplain();
            return;
        }
        const filmed = this.recording.filmed[this.tick], caption = byId("caption");
        this.stage.show(filmed).then(() => this.prepareFrames());
        caption.hidden = filmed === this.tick;
        const gap = this.recording.tick(this.tick).gap, why = gap ? `is a gap (${gap})` : "has no frame";
        caption.textContent = filmed < 0 ? "No tick up to here has a frame." :
            `Tick ${this.tick} ${why}; this is the frame of tick ${filmed}.`;
        byId("stage").classList.toggle("stale", filmed !== this.tick);
    }

    /* Show a recording without frames: start drawing, or say what is missing. If drawing cannot be started, Interaction
     * shows the error. */
    async drawOrExplain()
    {
        const caption = byId("caption");
        caption.textContent = this.interaction.canPlay ? NO_FRAMES : moduleText() ? NO_BROWSER : NO_MODULE;
        caption.hidden = this.interaction.canPlay && await this.interaction.start();
    }

    prepareFrames()
    {
        const ahead = [];
        for (let at = this.tick; ahead.length < FRAMES_AHEAD && (at = this.nextPlayed(at)) >= 0;)
            if (this.recording.filmed[at] >= 0)
                ahead.push(this.recording.filmed[at]);
        this.stage.prepare(ahead);
    }

    showFilter()
    {
        if (this.filter === this.shownFilter)
            return;
        this.shownFilter = this.filter;
        this.timeline.choose(this.filter);
        const count = this.recording.count(this.filter);
        byId("filtered").textContent = this.filter === 0 ? "" :
            `${counted(count, "tick")} with ${this.filterNames().join(" or ")}; j and k go to the next and previous.`;
    }

    showPlaying()
    {
        document.body.classList.toggle("playing", this.playing);
    }

    filterNames()
    {
        return EVENTS.filter((event, i) => this.filter & 1 << i).map(([name]) => name);
    }
}

/* ---- Keys and buttons --------------------------------------------------------------------------------------- */

/* The rows of KEYS that exist only in pages that can play. */
const PLAYING_KEYS = [
    ...[..."wsdaefn.q"].map(key => [[key], key, `play on from this tick: ${KEY_MEANINGS[key]}`,
                                   viewer => viewer.interaction.press(key)]),
    ...[["Left", "←", -1, 0], ["Right", "→", 1, 0], ["Up", "↑", 0, 1], ["Down", "↓", 0, -1]].map(
        ([name, sign, dx, dy]) => [[`Shift+Arrow${name}`], `Shift ${sign}`, "turn the view (or drag)",
                                   viewer => viewer.interaction.turn(dx, dy)]),
    [["Shift+PageUp"], "Shift Page Up", "zoom in (or scroll)", viewer => viewer.interaction.zoom(1.25)],
    [["Shift+PageDown"], "Shift Page Down", "zoom out", viewer => viewer.interaction.zoom(0.8)],
    [["o"], "o", "open or close the panel and legend", () => setOpen("column", !isOpen("column"))],
    [["v"], "v", "open or close the controls of the view, and queries", () => setOpen("tools", !isOpen("tools"))],
    [["m"], "m", "measure between two points", viewer => viewer.interaction.toggleMeasure()],
    [["c"], "c", "identify what is in the middle of the view (or click anywhere)", viewer => viewer.interaction.pick()],
];

/* The keys of the page. Each row has the key's names in KeyboardEvent, its name in the help, its help text, and its
 * action. */
const KEYS = keysOf([
    [["ArrowRight"], "→", "next tick", viewer => viewer.step(1)],
    [["ArrowLeft"], "←", "previous tick", viewer => viewer.step(-1)],
    [["PageDown"], "Page Down", "forward by 5 % of the ticks, at least ten", viewer => viewer.step(viewer.page)],
    [["PageUp"], "Page Up", "back by the same", viewer => viewer.step(-viewer.page)],
    [["Home"], "Home", "first tick", viewer => viewer.step(-Infinity)],
    [["End"], "End", "last tick", viewer => viewer.step(Infinity)],
    [[" "], "space", "play or pause", viewer => viewer.playing ? viewer.pause() : viewer.play()],
    [["+", "="], "+", "faster", viewer => viewer.changeSpeed(1)],
    [["-"], "-", "slower", viewer => viewer.changeSpeed(-1)],
    [["j"], "j", "next selected event; without a selection, any event except moved", viewer => viewer.seekMatch(1)],
    [["k"], "k", "previous selected event", viewer => viewer.seekMatch(-1)],
    ...EVENTS.filter(([, , of]) => of !== "rare").map(([name], i) =>
        [[String(i + 1)], String(i + 1), `select or deselect ${name}`, viewer => viewer.toggle(1 << i)]),
    [["0"], "0", "clear the selection", viewer => viewer.clearFilter()],
    ...(hasModule() ? PLAYING_KEYS : []),
    [["i"], "i", "open or close the facts of the tick", () => setOpen("sheet", !isOpen("sheet"))],
    [["p"], "p", "show the recorded pixels, or fill the window",
     viewer => viewer.showExact(!viewer.interaction.exact)],
    [["l"], "l", "copy a link to exactly this view", viewer => viewer.address.copy()],
    [["b"], "b", "open or close the list of events", () => setOpen("events", !isOpen("events"))],
    [["z"], "z", "zoom the lanes in at the current tick (or scroll over them)", viewer => viewer.timeline.zoom(1.5)],
    [["x"], "x", "zoom the lanes out", viewer => viewer.timeline.zoom(1 / 1.5)],
    [["t"], "t", "open or fold the timeline", viewer => viewer.foldTimeline(!isFolded())],
    [["Escape"], "Esc", "close the facts or the view; then back to the recording or session",
     viewer => closeSheet() || viewer.interaction.goBack()],
    [["?"], "?", "show these keys", () => byId("help").showModal()],
]);

const BUTTONS = {"previous-match": "k", previous: "ArrowLeft", play: " ", next: "ArrowRight", "next-match": "j"};

function actionOf(key)
{
    return KEYS.find(([names]) => names.includes(key))?.[3];
}

/* Whether the focused control handles the pressed key itself. */
function isHandled(event)
{
    const control = event.target.closest?.("button, select, a, input, dialog");
    if (event.ctrlKey || event.altKey || event.metaKey || byId("help").open)
        return true;
    if (event.key === "Escape")
        return false;
    if (event.target.id === "stage" && document.body.classList.contains("exact"))
        return event.key.startsWith("Arrow"); /* arrow keys scroll a frame that is larger than the window */
    if (!control || control.type === "range")
        return false;
    return control.matches("input, select, dialog") || [" ", "Enter"].includes(event.key);
}

function listenToKeys(viewer)
{
    document.addEventListener("keydown", event => {
        const action = actionOf(event.shiftKey && event.key.length > 1 ? `Shift+${event.key}` : event.key);
        if (!action || isHandled(event))
            return;
        event.preventDefault();
        action(viewer);
    });
}

/* Go to the tick that the user typed. If the user did not type a number, the field shows the current tick again. */
function typeTick(viewer, tick)
{
    viewer.step(isNaN(tick) ? 0 : Math.trunc(tick) - viewer.tick);
}

function listenToControls(viewer)
{
    for (const button of document.querySelectorAll("[data-does]"))
        button.addEventListener("click", () => actionOf(BUTTONS[button.dataset.does])(viewer));
    /* Take the focus from a clicked button. Otherwise the space bar would press the button again, instead of
     * playing. */
    document.addEventListener("click", event => event.detail > 0 && event.target.closest("button")?.blur());
    byId("speed").addEventListener("change", event => event.target.blur());
    byId("slider").addEventListener("input", event => viewer.goTo(Number(event.target.value)));
    byId("tick").addEventListener("change", event => typeTick(viewer, event.target.valueAsNumber));
    byId("tick").addEventListener("keydown", event => event.key === "Enter" && event.target.blur());
    byId("help-open").addEventListener("click", () => actionOf("?")(viewer));
    byId("measure").hidden = !hasModule();
    byId("measure").addEventListener("click", () => viewer.interaction.toggleMeasure());
    byId("pixels").addEventListener("click", () => actionOf("p")(viewer));
    byId("fold").addEventListener("click", () => actionOf("t")(viewer));
}

/* ---- The page ----------------------------------------------------------------------------------------------- */

/* The name of the recording: the name of its folder. If the page's file is not called index.html, the name of that
 * file. */
function recordingName()
{
    const [folder, file] = location.pathname.split("/").slice(-2);
    const name = file === "index.html" || !file ? folder ?? "" : file.replace(/\.html$/, "");
    try {
        return decodeURIComponent(name);
    } catch {
        return name; /* the name contains a % that encodes no character */
    }
}

function describeRecording(recording)
{
    const {size: [width, height], camera} = recording.about, name = recordingName();
    const frames = recording.filmed.reduce((count, filmed, i) => count + (filmed === i ? 1 : 0), 0);
    const {points} = recording.tick(0).tree ?? {};
    const parts = [isCloudPage && points !== undefined ? counted(points, "point") : counted(recording.length, "tick"), frames && counted(frames, "frame"), `${width} × ${height}`, camera];
    byId("about").append(element("strong", name), " ", parts.filter(Boolean).join(" · "));
    document.title = name ? `${name} – Octreel` : "Octreel recording";
}

function fillControls()
{
    for (const speed of SPEEDS)
        byId("speed").append(new Option(`${speed} / s`, speed, speed === START_SPEED, speed === START_SPEED));
    for (const [, shown, words] of KEYS) {
        const row = element("tr", element("td", element("kbd", shown)));
        row.append(element("td", words));
        byId("help-keys").append(row);
    }
}

function openRecording()
{
    const recording = Recording.parse(typeof unpackedFacts === "string" ? unpackedFacts : byId("facts").textContent);
    if (recording.length === 0) {
        byId("message").textContent = "This recording has no ticks.";
        byId("message").hidden = false;
        return null;
    }
    byId("message").hidden = true;
    byId("viewer").hidden = false;
    arrange();
    showCloudParts(isCloudPage);
    describeRecording(recording);
    fillControls();
    const viewer = new Viewer(recording);
    byId("words").hidden = !viewer.interaction.canPlay;
    viewer.follow(recording);
    listenToKeys(viewer);
    listenToControls(viewer);
    viewer.address.read();
    viewer.begins(viewer.interaction.canPlay && viewer.interaction.start());
    return viewer;
}

const octreel = openRecording(); /* a global variable, for the browser's console and the tests */
