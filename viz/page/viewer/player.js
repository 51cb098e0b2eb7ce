/* SPDX-License-Identifier: MIT */
/* player.js - reaches any tick of a session in a few milliseconds. One engine, the scout, plays ahead and saves states.
 * The other engine goes back to the nearest saved state, plays from there to the tick, and draws. The user's key
 * presses replace the session's ticks from some tick on. */
"use strict";

const SLICE = 12;         /* ms of playing before control returns to the browser */
/* Maximum size of a state in bytes for which there is a scout, because the scout needs as much memory again. */
const MOST_AHEAD = 64 << 20;

const MAX_TICKS = 100000; /* maximum number of ticks to play, because a session may have a billion ticks */

const nextTask = () => new Promise(done => setTimeout(done));

class Player {
    /* `known` is the number of ticks whose facts the recording has. `played(tick, engine)` is called for each tick that
     * is played ahead. `points` is the block of the points of a cloud or of a large session, otherwise empty. */
    constructor(module, session, view, known, played, points = NO_POINTS)
    {
        this.points = points;
        this.module = module;
        this.maxTicks = Math.max(MAX_TICKS, known);
        this.played = played;
        this.states = new States();
        this.keys = ""; /* the user's key presses, played after tick `branch` */
        this.run = 0;   /* number of the current run of the scout; a new run ends the previous run */
        this.engine = new Engine(module);
        this.engine.open(session, view, points);
        this.given = this.length; /* number of ticks of the session itself, without the user's ticks */
        this.branch = this.given - 1;
        if (!this.isCloud) /* a cloud has one tick: its state is kept before the first query */
            this.states.keep(this.engine, false);
        this.playsAhead = this.engine.used().length <= MOST_AHEAD;
        this.scout = null; /* the engine that plays ahead; created after the first picture is drawn */
    }

    /* The number of ticks that can be shown. */
    get length()
    {
        return this.isBranched ? this.branch + 1 + this.keys.length : Math.min(this.engine.length, this.maxTicks);
    }

    get isCut()
    {
        return !this.isBranched && this.engine.length > this.maxTicks;
    }

    get isCloud()
    {
        return isCloud(this.points);
    }

    get isBranched()
    {
        return this.keys.length > 0;
    }

    /* Play the next tick of an engine, with the user's key press if there is one for this tick. */
    step(engine)
    {
        engine.step(engine.tick >= this.branch ? this.keys[engine.tick - this.branch] : "");
    }

    /* Play ahead to the last tick in the background, and save states on the way. */
    async playAhead(progress)
    {
        const run = ++this.run;
        let since = 0;
        await nextTask();
        const scout = run === this.run && !this.isCloud ? this.scout ?? this.makeScout() : null;
        while (scout && run === this.run && scout.tick + 1 < this.length) {
            const start = performance.now();
            let now = start;
            while (scout.tick + 1 < this.length && now - start < SLICE && since + now - start < this.states.interval) {
                this.step(scout);
                this.played(scout.tick, scout);
                now = performance.now();
            }
            since += now - start;
            if (since >= this.states.interval) {
                this.states.keep(scout, this.isBranched);
                since = 0;
            }
            progress(scout.tick, this.length - 1);
            await nextTask();
        }
        if (run === this.run)
            progress(this.length - 1, this.length - 1);
    }

    makeScout()
    {
        if (this.playsAhead) {
            this.scout = new Engine(this.module);
            this.restore(this.scout, this.states.before(0));
        }
        return this.scout;
    }

    /* Stop playing ahead in the background. */
    stop()
    {
        this.run++;
    }

    /* Bring the engine that draws to a tick. Returns false if a later call replaced this call. */
    async goTo(tick)
    {
        const going = this.going = {};
        const state = this.states.before(tick), engine = this.engine;
        if (engine.tick > tick || state?.tick > engine.tick)
            this.restore(engine, state);
        for (let start = performance.now(); engine.tick < tick && engine.tick + 1 < this.length;) {
            this.step(engine);
            if (performance.now() - start < SLICE)
                continue;
            await nextTask();
            start = performance.now();
            if (going !== this.going)
                return false;
        }
        return true;
    }

    /* Play the shown tick once more, without the user's query. */
    replay()
    {
        const {engine, states} = this, {tick} = engine;
        if (states.list.length === 0)
            states.keep(engine, false);
        for (this.restore(engine, this.states.before(tick)); engine.tick < tick;)
            this.step(engine);
    }

    restore(engine, state)
    {
        engine.restore(state);
        if (this.isBranched)
            engine.setKeys(this.branch, this.keys);
    }

    /* Play the user's key press after the shown tick. All later ticks are dropped. */
    press(key)
    {
        const {engine, scout} = this;
        if (!this.isBranched || engine.tick < this.branch) {
            this.branch = engine.tick;
            this.keys = "";
        }
        this.keys = this.keys.slice(0, engine.tick - this.branch) + key;
        this.going = {};
        engine.setKeys(this.branch, this.keys);
        if (scout?.tick > engine.tick)
            this.rewind(state => state.tick > engine.tick);
        else
            scout?.setKeys(this.branch, this.keys);
        this.step(engine);
    }

    /* Drop the states for which isForgotten(state) is true, and play ahead again from the last remaining state. */
    rewind(isForgotten)
    {
        this.run++;
        this.states.forget(isForgotten);
        if (this.scout)
            this.restore(this.scout, this.states.list.at(-1));
    }

    /* Open the session once more, at tick 0, because the view shows sums over all ticks. */
    reopen(session)
    {
        const {engine} = this;
        this.stop();
        this.going = {};
        engine.open(session, engine.view, this.points);
        this.states = new States();
        this.states.keep(engine, false);
        for (const one of this.scout ? [engine, this.scout] : [engine])
            this.restore(one, this.states.list[0]);
    }

    /* Go back to tick 0 of the session itself, without the user's key presses and with a view. */
    restart(view)
    {
        if (this.isCloud) { /* opening the cloud once more would take seconds */
            if (this.states.list.length > 0)
                this.replay();
            this.engine.look(view);
            return;
        }
        this.keys = "";
        this.branch = this.given - 1;
        this.going = {};
        this.rewind(state => state.isBranched);
        this.engine.view = view;
        this.restore(this.engine, this.states.list[0]);
    }

    /* The text of session.json for the session, with the user's key presses. */
    save()
    {
        return this.engine.session();
    }
}
