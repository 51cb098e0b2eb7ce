/* SPDX-License-Identifier: MIT */
/* interaction.js - the page plays: at the first gesture it begins to draw by itself, and from any tick the keys of the
 * game play on. */
"use strict";

const LONG_WAIT = 100; /* ms: what takes longer has a bar */
const LARGE = 1 << 20; /* letters of a session */
const MOST_FILE = 256 << 20; /* bytes of a session that is dropped */
const FEW = 4; /* elements at a pixel that are shown without asking for more */

/* The view of a session that has none: that of a recording without what depends on its world. */
function plainView(about)
{
    const {fit, look, center, zoom, slice, region, depths, derived, ...view} = about;
    return view;
}

/* The name of a file as a word of a sentence: on one line, in one direction, and not too long. */
const shownName = name => name.replace(/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/gu, "?").replace(/^(.{60}).+$/u, "$1…");

/* The text of a session file. One that is none is not read to its end, nor one that no page could hold. */
async function readSession(file)
{
    const read = part => part.text().catch(() => {
        throw new Error("it cannot be read; of a folder, drop the session.json that is in it");
    });
    if (!/^\s*\{/.test(await read(file.slice(0, 4096))))
        throw new Error("it is no session.json");
    if (file.size > MOST_FILE)
        throw new Error(`it is larger than ${MOST_FILE >> 20} MiB, which a page does not take; octreel record films it`);
    return read(file);
}

class Interaction {
    constructor(viewer)
    {
        this.viewer = viewer;
        this.stage = byId("stage");
        this.busy = false;
        this.recorded = viewer.recording;
        this.plays = hasModule();
        if (this.plays)
            this.listen();
    }

    get isLive()
    {
        return this.live !== undefined;
    }

    tell(text)
    {
        byId("told").textContent = text;
    }

    /* ---- Begin and end ------------------------------------------------------------------------------------------ */

    /* Begin to draw, once. False where that cannot be, which is told. */
    start()
    {
        return this.starting ??= this.begin().catch(error => {
            this.starting = undefined;
            this.tell(`The page cannot play: ${error.message}`);
            return false;
        });
    }

    async begin()
    {
        this.module ??= await compileModule();
        this.session ??= byId("session").textContent.trim();
        if (!this.session)
            throw new Error("the session is not in the page, as it is large; drop session.json here");
        await this.take(this.session, this.recorded.about, this.recorded);
        return true;
    }

    /* Play a session from now on. A large one takes a while to be read, of which nothing is known. */
    async take(session, view, recording)
    {
        const bar = byId("ahead");
        if (session.length > LARGE) {
            bar.removeAttribute("value");
            bar.hidden = false;
            await new Promise(done => setTimeout(done, 20));
        }
        const player = this.makePlayer(session, view, recording.length);
        if (recording.length === 0)
            recording.append(player.engine.facts());
        this.player?.stop();
        this.player = player;
        this.session = session;
        this.recorded = recording;
        this.makeControls(player.engine.choices());
        this.live = new Live(this.stage, player, {
            told: text => this.tell(text),
            picked: (pick, place) => this.showPick(pick, place),
            changed: () => this.showView(),
            again: () => this.playAgain(),
        });
        this.viewer.follow(recording);
        this.showView();
        this.showTaken();
        byId("view").hidden = byId("asking").hidden = false;
        byId("live-start").hidden = true;
        byId("hint").hidden = recording.hasFrames; /* else nobody began, and has not read it */
        byId("caption").hidden = true;
        this.stage.classList.remove("stale");
        this.tell(player.isCut ? `The session has ${grouped(player.engine.length)} ticks, of which this page plays the ` +
                                 `first ${grouped(player.length)}.` : "");
        const {tick} = this.viewer;
        if (tick > 0)
            this.playAhead();
        await this.show(tick);
        if (tick === 0) /* whose picture needs no other tick, and does not wait for them */
            this.playAhead();
    }

    makePlayer(session, view, known)
    {
        try {
            return new Player(this.module, session, view, known, (tick, engine) => this.hear(tick, engine));
        } finally {
            byId("ahead").hidden = true;
        }
    }

    makeControls(choices)
    {
        if (this.controls)
            return;
        this.controls = new ViewControls(byId("view-rows"), choices, changes => this.live?.look(changes));
        this.form = new AskForm(byId("ask"), choices.queries, {ask: query => this.ask(query), forget: () => this.ask()});
    }

    playAhead()
    {
        const start = performance.now(), bar = byId("ahead");
        this.player.playAhead((tick, last) => {
            bar.hidden = tick >= last || performance.now() - start < LONG_WAIT;
            bar.value = last > 0 ? tick / last : 1;
        }).catch(error => this.tell(error.message));
    }

    /* All from the beginning, up to what is shown. */
    playAgain()
    {
        this.player.reopen(this.session);
        this.playAhead();
        return this.show(this.viewer.tick);
    }

    /* A tick that was played: its facts, where they are not known. */
    hear(tick, engine)
    {
        const recording = this.viewer.recording;
        if (recording.length !== tick)
            return;
        recording.append(engine.facts());
        this.viewer.follow(recording);
    }

    /* Show a tick; of several that are asked for meanwhile, the last. */
    async show(tick)
    {
        this.wanted = Math.min(tick, this.player.length - 1);
        if (this.busy)
            return;
        this.busy = true;
        try {
            do {
                await this.player.goTo(this.wanted);
                await this.live?.draw();
            } while (this.isLive && this.player.engine.tick !== this.wanted);
        } catch (error) {
            this.tell(error.message);
        }
        this.busy = false;
    }

    /* To the recording and its frames. */
    goBack()
    {
        if (!this.isLive)
            return;
        this.player.stop();
        this.live.hide();
        this.live = this.starting = undefined;
        for (const hidden of ["view", "asking", "live-end", "save", "taken", "picked", "ahead"])
            byId(hidden).hidden = true;
        byId("live-start").hidden = byId("hint").hidden = false;
        this.tell("");
        this.viewer.stage.shown = -1;
        this.viewer.follow(this.recorded);
        this.viewer.goTo(this.viewer.tick);
    }

    /* By keys, which begin as dragging does. */
    async turn(dx, dy)
    {
        if (await this.start())
            this.live?.turnStep(dx, dy);
    }

    async pick()
    {
        if (await this.start())
            this.live?.pickAt();
    }

    async zoom(factor)
    {
        if (await this.start())
            this.live?.zoomStep(factor);
    }

    /* ---- Taking over -------------------------------------------------------------------------------------------- */

    /* One key after the other, however fast they come. */
    press(key)
    {
        this.pressed = (this.pressed ?? Promise.resolve()).then(() => this.playKey(key));
        return this.pressed;
    }

    async playKey(key)
    {
        if (!(await this.start()))
            return;
        const {viewer, player} = this;
        viewer.pause();
        do /* while it goes there, another tick may be wanted */
            await player.goTo(viewer.tick);
        while (player === this.player && player.engine.tick !== Math.min(viewer.tick, player.length - 1));
        if (!this.isLive || player !== this.player)
            return;
        if (key === "q") {
            this.tell(player.isTaken ? "The game has ended. Save it, or go back." : "");
            return;
        }
        try {
            player.press(key);
        } catch (error) {
            this.tell(error.message);
            return;
        }
        const recording = viewer.recording === this.recorded || viewer.recording.length > viewer.tick + 1
            ? viewer.recording.cut(viewer.tick + 1) : viewer.recording;
        recording.append(player.engine.facts());
        viewer.follow(recording);
        this.showTaken();
        this.playAhead();
        viewer.goTo(recording.length - 1);
    }

    showTaken()
    {
        const {isTaken, taken, keys, given} = this.player;
        const without = taken < given - 1 ? ", without what the session has after it" : "";
        byId("taken").hidden = byId("save").hidden = !isTaken;
        byId("taken").textContent = `Played from tick ${grouped(taken)}${without}: ${keys.slice(-24)}`;
        this.showWayBack();
    }

    /* To frames always; where there are none, from another view and from what was played. */
    showWayBack()
    {
        const {hasFrames} = this.recorded, button = byId("live-end");
        button.textContent = hasFrames ? "Back to the recording" : "Back to the session";
        button.hidden = !hasFrames && !this.player.isTaken && byId("view-options").hidden;
    }

    save()
    {
        if (!this.isLive)
            return;
        const blob = new Blob([this.player.save()], {type: "application/json"});
        const link = element("a", "", {href: URL.createObjectURL(blob), download: "session.json"});
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 1000);
        this.tell("octreel record session.json films exactly this.");
    }

    async open(file)
    {
        try {
            this.module ??= await compileModule();
            const text = await readSession(file);
            await this.take(text, plainView(this.recorded.about), new Recording(this.recorded.about, []));
            this.starting = Promise.resolve(true);
            this.viewer.goTo(0);
        } catch (error) {
            this.tell(`${shownName(file.name)} cannot be opened: ${error.message.replace(/^the session:/, "line ")}`);
        }
    }

    /* Ask something else about this tick, or nothing. What is asked is answered in the picture and among the facts. */
    ask(query)
    {
        if (!this.isLive)
            return undefined;
        const {engine} = this.player;
        try {
            this.player.replay();
            if (query)
                engine.ask([query]);
            this.tell("");
        } catch (error) {
            this.tell(error.message.replace(/^the question:\d+: queries\[0\]\.?/, "what is asked: "));
        }
        showTick(byId("facts-of-tick"), JSON.parse(engine.facts()));
        return this.live.draw();
    }

    /* ---- What is shown ------------------------------------------------------------------------------------------ */

    showView()
    {
        const {view} = this.player.engine;
        const options = optionsOf(view, this.recorded.about);
        this.controls.show(view);
        byId("view-options").hidden = options === "";
        byId("view-options").querySelector("code").textContent = options;
        this.showWayBack();
    }

    showPick({pixel, color, elements}, place)
    {
        const {min, max} = this.player.engine.world();
        this.form.setPlace(place, Math.max(...max.map((high, i) => high - min[i])));
        const root = byId("picked"), texts = elements.map(({text, closeup}) => element("li", closeup ? `${text} (in the close-up)` : text));
        const list = element("ol"), rest = texts.splice(FEW);
        list.append(...texts);
        root.hidden = false;
        root.replaceChildren(element("h2", pixel ? `At (${pixel.join(", ")}), ${color}` : "Nothing is drawn there"), list);
        if (rest.length === 0)
            return;
        const more = element("details", element("summary", `and ${rest.length} more`));
        more.append(element("ol", "", {start: FEW + 1}));
        more.lastChild.append(...rest);
        root.append(more);
    }

    /* ---- Gestures ----------------------------------------------------------------------------------------------- */

    listen()
    {
        const {stage} = this;
        byId("live-bar").hidden = false;
        document.body.classList.add("plays");
        byId("live-start").addEventListener("click", () => this.start());
        byId("live-end").addEventListener("click", () => this.goBack());
        byId("save").addEventListener("click", () => this.save());
        const held = new Set(); /* a click may end before the page has begun to draw */
        stage.addEventListener("pointerdown", event => {
            held.add(event.pointerId);
            this.start().then(begun => begun && (held.has(event.pointerId) ? this.live?.down(event) : this.live?.pickAt(event)));
        });
        stage.addEventListener("pointermove", event => this.live?.drag(event));
        for (const end of ["pointerup", "pointercancel"])
            stage.addEventListener(end, event => {
                held.delete(event.pointerId);
                if (this.live?.up(event))
                    this.live.pickAt(event);
            });
        stage.addEventListener("contextmenu", event => event.preventDefault());
        stage.addEventListener("wheel", event => {
            event.preventDefault();
            this.start().then(begun => begun && this.live?.wheel(event));
        }, {passive: false});
        document.addEventListener("dragover", event => event.preventDefault());
        document.addEventListener("drop", event => {
            event.preventDefault();
            if (event.dataTransfer.files.length > 0)
                this.opening = this.open(event.dataTransfer.files[0]);
        });
    }
}
