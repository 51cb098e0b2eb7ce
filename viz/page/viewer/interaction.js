/* SPDX-License-Identifier: MIT */
/* interaction.js - playing in the page. The WebAssembly module draws in place of the recorded frames, at the size of the
 * window. From any tick on, the user can continue the game with the keys of the player. */
"use strict";

const LONG_WAIT = 100; /* ms; if the user waits longer, a progress bar is shown */
const LARGE = 1 << 22; /* characters; before a longer session is read, a progress bar is shown */
const MOST_FILE = 256 << 20; /* the maximum size of a session file in bytes */

/* A view for a session that comes without a view: the recording's view, without the options that depend on the
 * recording's world. */
function plainView(about)
{
    const {fit, look, center, zoom, slice, region, depths, derived, ...view} = about;
    return view;
}

/* A file name that is safe in a sentence: without line breaks and changes of text direction, and with at most 60
 * characters. */
const shownName = name => name.replace(/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/gu, "?").replace(/^(.{60}).+$/u, "$1…");

/* Read the text of a session file. Reading stops early if the file does not start as JSON or is too large. */
async function readSession(file)
{
    const read = part => part.text().catch(() => {
        throw new Error("it cannot be read; if it is a folder, drop the session.json in it");
    });
    if (!/^\s*\{/.test(await read(file.slice(0, 4096))))
        throw new Error("not a session.json file");
    if (file.size > MOST_FILE)
        throw new Error(`larger than ${MOST_FILE >> 20} MiB, the most that a page opens; use octreel record`);
    return read(file);
}

class Interaction {
    constructor(viewer)
    {
        this.viewer = viewer;
        this.stage = byId("stage");
        this.exact = false; /* true: the page shows recorded pixels */
        this.recorded = viewer.recording;
        this.canPlay = hasModule();
        if (this.canPlay)
            this.listen();
    }

    get isLive()
    {
        return this.live !== undefined;
    }

    /* Whether the page shows the recorded frames. If not, it shows pictures that the module draws. */
    get showsFrames()
    {
        return !this.isLive || (this.exact && this.recorded.hasFrames && byId("live-end").hidden);
    }

    showStatus(text)
    {
        byId("status").textContent = text;
    }

    /* ---- Begin and end ------------------------------------------------------------------------------------------ */

    /* Start the module and draw the shown tick. Later calls do nothing. Returns false if the start fails; the page then
     * shows the error. */
    start()
    {
        return this.starting ??= this.begin().catch(error => {
            this.starting = undefined;
            setOpen("column", false);
            this.showStatus(`The page cannot play: ${error.message}`);
            return false;
        });
    }

    async begin()
    {
        this.module ??= await compileModule();
        this.session ??= byId("session").textContent.trim();
        if (!this.session)
            throw new Error("the session is too large to be in the page; drop its session.json here");
        this.points ??= await unpackPoints();
        await this.play(this.session, this.recorded.about, this.recorded, this.points);
        this.viewer.address.apply();
        return true;
    }

    /* Play a session from now on. While a large session is read, the progress bar shows no value. */
    async play(session, view, recording, points = NO_POINTS)
    {
        const bar = byId("ahead");
        if (session.length + points.length > LARGE) {
            bar.removeAttribute("value");
            bar.hidden = false;
            await new Promise(done => setTimeout(done, 20));
        }
        const player = this.makePlayer(session, view, recording.length, points);
        if (player.isCloud) /* the page itself has only the counts of the tree */
            recording = new Recording(recording.about, []);
        if (recording.length === 0)
            recording.append(player.engine.facts());
        this.player?.stop();
        this.live?.end();
        this.player = player;
        this.session = session;
        this.firstView = view;
        this.recorded = recording;
        this.makeControls(player.engine.choices());
        this.live = new Live(this.stage, player, {
            showStatus: text => this.showStatus(text),
            picked: (pick, place, ray) => this.showPick(pick, place, ray),
            changed: () => this.showView(),
            again: () => this.playAgain(),
            appears: () => this.viewer.stage.leave(),
            showRows,
        });
        this.live.exact = this.exact;
        this.measure = new Measure(this.live, text => this.showStatus(text));
        showCloudParts(player.isCloud);
        this.viewer.follow(recording);
        this.showView();
        this.showBranch();
        byId("view").hidden = byId("asking").hidden = false;
        this.showStatus(!player.isCut ? "" : `The session has ${grouped(player.engine.length)} ticks; ` +
                                             `this page plays the first ${grouped(player.length)}.`);
        this.viewer.address.applyView();
        const {tick} = this.viewer;
        if (tick > 0)
            this.playAhead();
        await this.show(tick);
        if (tick === 0) /* draw tick 0 before playing ahead: it needs no earlier ticks */
            this.playAhead();
    }

    makePlayer(session, view, known, points)
    {
        try {
            return new Player(this.module, session, view, known, (tick, engine) => this.appendTick(tick, engine), points);
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
        }).catch(error => this.showStatus(error.message));
    }

    /* Play from tick 0 to the shown tick once more, because the view needs sums over all ticks. */
    playAgain()
    {
        this.player.reopen(this.session);
        this.playAhead();
        return this.show(this.viewer.tick);
    }

    /* Add the facts of a tick that was just played, unless the recording already has this tick. */
    appendTick(tick, engine)
    {
        const recording = this.viewer.recording;
        if (recording.length !== tick)
            return;
        recording.append(engine.facts());
        this.viewer.follow(recording);
    }

    /* Whether a picture is being made. */
    get busy()
    {
        return this.showing !== undefined;
    }

    /* Show a tick. If several ticks are requested during the drawing, only the last of them is shown. */
    show(tick)
    {
        this.wanted = Math.min(tick, this.player.length - 1);
        return this.showing ??= this.showWanted();
    }

    async showWanted()
    {
        try {
            do {
                if (this.player.engine.tick !== this.wanted)
                    this.asked = undefined;
                await this.player.goTo(this.wanted);
                if (!this.showsFrames)
                    await this.live.draw();
                this.viewer.inspector.follow();
            } while (this.isLive && this.player.engine.tick !== this.wanted);
        } catch (error) {
            this.showStatus(error.message);
        }
        this.showing = undefined; /* set without another await: show() must not wait for a loop that has ended */
    }

    /* Show the first view of the recorded ticks again. */
    goBack()
    {
        this.measure?.stop();
        if (!this.isLive || byId("live-end").hidden)
            return;
        this.restart(this.firstView);
        this.showStatus("");
        this.viewer.goTo(this.viewer.tick);
    }

    /* Play the session without the user's key presses, with a view. */
    restart(view)
    {
        this.asked = undefined;
        this.player.restart(view);
        this.viewer.follow(this.recorded);
        this.showView();
        this.showBranch();
        this.playAhead();
    }

    /* Show recorded pixels from the next picture on, or pictures that fill the window. */
    showExact(exact)
    {
        this.exact = exact;
        if (this.isLive)
            this.live.exact = exact;
        if (this.isLive && this.showsFrames)
            this.live.stale = false; /* a picture that was requested before would replace the frame */
        showExact(exact, this.recorded.about.size);
    }

    /* Turn the camera by a key. */
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

    async toggleMeasure()
    {
        if (await this.start())
            this.measure?.toggle();
    }

    async zoom(factor)
    {
        if (await this.start())
            this.live?.zoomStep(factor);
    }

    /* ---- Playing on -------------------------------------------------------------------------------------------- */

    /* Play the user's key press after all key presses that came before it. */
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
        do /* the viewer may go to another tick while the player is on its way */
            await player.goTo(viewer.tick);
        while (player === this.player && player.engine.tick !== Math.min(viewer.tick, player.length - 1));
        if (!this.isLive || player !== this.player)
            return;
        if (key === "q") {
            this.showStatus(player.isBranched ? "The game has ended. Save the session, or go back." : "");
            return;
        }
        try {
            player.press(key);
            this.asked = undefined;
        } catch (error) {
            this.showStatus(error.message);
            return;
        }
        const recording = viewer.recording === this.recorded || viewer.recording.length > viewer.tick + 1
            ? viewer.recording.cut(viewer.tick + 1) : viewer.recording;
        recording.append(player.engine.facts());
        viewer.follow(recording);
        this.showBranch();
        this.playAhead();
        viewer.goTo(recording.length - 1);
    }

    /* The tick from which the user played on, and the user's key presses, as "30:wwd"; empty if there are none. */
    get branchText()
    {
        return this.isLive && this.player.isBranched ? `${this.player.branch}:${this.player.keys}` : "";
    }

    /* Play the key presses of a text like branchText, and show a tick. */
    async playKeys(text, tick)
    {
        const [, branch, keys] = /^(\d{1,9}):([wsadefn.]{1,9999})$/.exec(text) ?? [];
        if (this.player.isBranched)
            this.restart(this.player.engine.view);
        if (keys)
            this.viewer.goTo(Number(branch));
        for (const key of keys ?? "")
            await this.press(key);
        this.viewer.goTo(tick);
        await this.show(this.viewer.tick);
        if (text && !keys)
            throw new Error(`"${shownName(text)}" are no key presses`);
    }

    /* Select an element by its name, or none. */
    async select(name)
    {
        const {inspector} = this.viewer;
        inspector.name = "";
        this.live.subject = null;
        byId("picked").hidden = true;
        this.live.mark();
        if (name && !(/^\w+ [\w/]+$/.test(name) && inspector.describe(name)))
            throw new Error(`tick ${this.viewer.tick} has no "${shownName(name)}"`);
        if (name)
            await inspector.select(name);
    }

    showBranch()
    {
        const {isBranched, branch, keys, given} = this.player;
        const without = branch < given - 1 ? "; the session's own later ticks are left out" : "";
        byId("branch").hidden = byId("save").hidden = !isBranched;
        byId("branch").textContent = byId("branch").title = `Played on from tick ${grouped(branch)}${without}: ${keys.slice(-24)}`;
        this.showBackButton();
    }

    /* After the user has changed the view or pressed a key of the game, show the button that leads back. */
    showBackButton()
    {
        const button = byId("live-end");
        button.textContent = this.player.isCloud ? "Reset the view"
            : this.recorded.hasFrames ? "Back to the recording" : "Back to the session";
        button.hidden = !this.player.isBranched && byId("view-options").hidden;
    }

    save()
    {
        if (!this.isLive)
            return;
        const blob = new Blob([this.player.save()], {type: "application/json"});
        const link = element("a", "", {href: URL.createObjectURL(blob), download: "session.json"});
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 1000);
        this.showStatus("To record its frames, run octreel record session.json.");
    }

    async open(file)
    {
        try {
            this.module ??= await compileModule();
            const text = await readSession(file);
            await this.play(text, plainView(this.recorded.about), new Recording(this.recorded.about, []));
            this.opened = file.name; /* the name of the file whose session replaces that of the page */
            this.starting = Promise.resolve(true);
            this.viewer.goTo(0);
        } catch (error) {
            const reason = error.message.replace(/^the session:/, "line ");
            this.showStatus(`${shownName(file.name)} cannot be opened: ${reason}`);
        }
    }

    /* Replace the user's query at this tick, or remove it if `query` is missing. The answer appears in the picture and
     * among the facts. */
    ask(query)
    {
        if (!this.isLive)
            return undefined;
        const {engine} = this.player;
        this.asked = undefined;
        try {
            this.player.replay();
            if (query)
                engine.ask([query]);
            this.asked = query && JSON.stringify(query);
            this.showStatus("");
        } catch (error) {
            this.showStatus(error.message.replace(/^the query:\d+: queries\[0\]\.?/, "query: "));
        }
        this.viewer.inspector.show(JSON.parse(engine.facts()));
        this.viewer.address.writeSoon();
        return this.live.draw();
    }

    /* ---- What is shown ------------------------------------------------------------------------------------------ */

    /* The options that turn the recorded view into the shown one (see optionsOf). */
    changedOptions(all)
    {
        return this.isLive ? optionsOf(this.player.engine.view, this.firstView, all) : "";
    }

    /* Change the view of the next picture. Throws an error if the module refuses the view. */
    look(view)
    {
        this.player.engine.look(view);
        this.showView();
        if (this.player.engine.lacksSums)
            this.playAgain();
    }

    showView()
    {
        const options = this.changedOptions();
        this.controls.show(this.player.engine.view);
        this.viewer.address.writeSoon();
        byId("view-options").hidden = options === "";
        byId("view-options").querySelector("code").textContent = options;
        this.showBackButton();
    }

    showPick(pick, place, ray)
    {
        if (this.measure.isOn)
            this.measure.add(pick);
        const {min, max} = this.player.engine.world();
        this.form.setPlace(place, Math.max(...max.map((high, i) => high - min[i])), ray);
        setOpen("sheet", true);
        this.viewer.inspector.showPick(pick, this.live.subject);
        this.viewer.address.writeSoon();
    }

    /* ---- Gestures ----------------------------------------------------------------------------------------------- */

    listen()
    {
        const {stage} = this;
        byId("live-bar").hidden = false;
        byId("live-end").addEventListener("click", () => this.goBack());
        byId("save").addEventListener("click", () => this.save());
        const held = new Set(); /* ids of the pointers that are down: a click may end before the module has started */
        stage.addEventListener("pointerdown", event => {
            if (event.target === stage && this.exact)
                return; /* a scroll bar */
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
