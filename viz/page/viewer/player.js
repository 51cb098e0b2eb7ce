/* SPDX-License-Identifier: MIT */
/* player.js - reaches any tick of a session in a few milliseconds: one engine (the scout) plays ahead and saves states,
 * another goes back to the nearest state, plays from there and draws. Keys that the user plays replace the session's
 * ticks from one tick on. */
"use strict";

const SLICE = 12;         /* ms of playing before control returns to the browser */
const MOST_AHEAD = 64 << 20; /* bytes of a state; larger sessions have no scout, which needs as much again */

const MAX_TICKS = 100000; /* played at most: a session may have a billion */

const nextTask = () => new Promise(done => setTimeout(done));

class Player {
    /* `known`: ticks whose facts the recording has. `played(tick, engine)` is called for each tick that is played
     * ahead. */
    constructor(module, session, view, known, played)
    {
        this.module = module;
        this.maxTicks = Math.max(MAX_TICKS, known);
        this.played = played;
        this.states = new States();
        this.keys = ""; /* the user's, played after tick `branch` */
        this.run = 0;   /* number of the current run in the background; a new run ends the old one */
        this.engine = new Engine(module);
        this.engine.open(session, view);
        this.given = this.length; /* the ticks of the session itself */
        this.branch = this.given - 1;
        this.states.keep(this.engine, false);
        this.playsAhead = this.engine.used().length <= MOST_AHEAD;
        this.scout = null; /* the engine that plays ahead, made after the first picture */
    }

    /* Count of ticks that can be shown. */
    get length()
    {
        return this.isBranched ? this.branch + 1 + this.keys.length : Math.min(this.engine.length, this.maxTicks);
    }

    get isCut()
    {
        return !this.isBranched && this.engine.length > this.maxTicks;
    }

    get isBranched()
    {
        return this.keys.length > 0;
    }

    /* Play an engine's next tick. */
    step(engine)
    {
        engine.step(engine.tick >= this.branch ? this.keys[engine.tick - this.branch] : "");
    }

    /* Play ahead in the background to the last tick, and save states on the way. */
    async playAhead(progress)
    {
        const run = ++this.run;
        let since = 0;
        await nextTask();
        const scout = run === this.run ? this.scout ?? this.makeScout() : null;
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

    /* Stop playing ahead. */
    stop()
    {
        this.run++;
    }

    /* Bring the engine that draws to a tick. False if another call replaced this one. */
    async goTo(tick)
    {
        const going = this.going = {};
        const state = this.states.before(tick), engine = this.engine;
        if (engine.tick > tick || state.tick > engine.tick)
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

    /* Play the shown tick once more, which removes the user's query from it. */
    replay()
    {
        const {engine} = this, {tick} = engine;
        for (this.restore(engine, this.states.before(tick)); engine.tick < tick;)
            this.step(engine);
    }

    restore(engine, state)
    {
        engine.restore(state);
        if (this.isBranched)
            engine.setKeys(this.branch, this.keys);
    }

    /* Play a key after the shown tick; later ticks are dropped. */
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

    /* Drop states, and play ahead from the last one that is left. */
    rewind(isForgotten)
    {
        this.run++;
        this.states.forget(isForgotten);
        if (this.scout)
            this.restore(this.scout, this.states.list.at(-1));
    }

    /* Open the session once more, at tick 0, for a view that shows sums over all ticks. */
    reopen(session)
    {
        const {engine} = this;
        this.stop();
        this.going = {};
        engine.open(session, engine.view);
        this.states = new States();
        this.states.keep(engine, false);
        for (const one of this.scout ? [engine, this.scout] : [engine])
            this.restore(one, this.states.list[0]);
    }

    /* The session with the user's keys, as session.json. */
    save()
    {
        return this.engine.session();
    }
}
