/* SPDX-License-Identifier: MIT */
/* player.js - any tick of a session at once: one engine plays ahead and keeps states, another goes back to them and
 * draws. What is played by keys follows the session from the tick at which they took over. */
"use strict";

const SLICE = 12;         /* ms of playing before the page may do something else */
const MOST_AHEAD = 64 << 20; /* bytes of a state: larger sessions are not played ahead, as that takes two of them */

const MOST_TICKS = 100000; /* that are played ahead; a session may say a billion */

const rest = () => new Promise(done => setTimeout(done));

class Player {
    /* `known`: ticks whose facts are known. `heard(tick, engine)` is told each tick that is played ahead. */
    constructor(module, session, view, known, heard)
    {
        this.module = module;
        this.most = Math.max(MOST_TICKS, known);
        this.heard = heard;
        this.states = new States();
        this.keys = ""; /* played after tick `taken` */
        this.run = 0;   /* the number of what goes on in the background; a new one ends the old */
        this.engine = new Engine(module);
        this.engine.open(session, view);
        this.given = this.length; /* ticks, whatever is played after some of them */
        this.taken = this.given - 1;
        this.states.keep(this.engine, false);
        this.playsAhead = this.engine.used().length <= MOST_AHEAD;
        this.scout = null; /* who plays ahead, once the first picture is drawn */
    }

    /* The ticks that are played. */
    get length()
    {
        return this.isTaken ? this.taken + 1 + this.keys.length : Math.min(this.engine.length, this.most);
    }

    get isCut()
    {
        return !this.isTaken && this.engine.length > this.most;
    }

    get isTaken()
    {
        return this.keys.length > 0;
    }

    /* Play the tick after an engine's. */
    step(engine)
    {
        engine.step(engine.tick >= this.taken ? this.keys[engine.tick - this.taken] : "");
    }

    /* Play ahead in the background, to the end of what is known, and keep states on the way. */
    async playAhead(progress)
    {
        const run = ++this.run;
        let since = 0;
        await rest();
        const scout = run === this.run ? this.scout ?? this.sendScout() : null;
        while (scout && run === this.run && scout.tick + 1 < this.length) {
            const start = performance.now();
            let now = start;
            while (scout.tick + 1 < this.length && now - start < SLICE && since + now - start < this.states.interval) {
                this.step(scout);
                this.heard(scout.tick, scout);
                now = performance.now();
            }
            since += now - start;
            if (since >= this.states.interval) {
                this.states.keep(scout, this.isTaken);
                since = 0;
            }
            progress(scout.tick, this.length - 1);
            await rest();
        }
        if (run === this.run)
            progress(this.length - 1, this.length - 1);
    }

    sendScout()
    {
        if (this.playsAhead) {
            this.scout = new Engine(this.module);
            this.restore(this.scout, this.states.before(0));
        }
        return this.scout;
    }

    /* Play no further ahead. */
    stop()
    {
        this.run++;
    }

    /* Bring the engine that draws to a tick. False where another call came meanwhile. */
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
            await rest();
            start = performance.now();
            if (going !== this.going)
                return false;
        }
        return true;
    }

    /* The tick that is shown, played once more: without what was asked about it since. */
    replay()
    {
        const {engine} = this, {tick} = engine;
        for (this.restore(engine, this.states.before(tick)); engine.tick < tick;)
            this.step(engine);
    }

    restore(engine, state)
    {
        engine.restore(state);
        if (this.isTaken)
            engine.setKeys(this.taken, this.keys);
    }

    /* Play a key after the tick that is shown: what was known after it is left. */
    press(key)
    {
        const {engine, scout} = this;
        if (!this.isTaken || engine.tick < this.taken) {
            this.taken = engine.tick;
            this.keys = "";
        }
        this.keys = this.keys.slice(0, engine.tick - this.taken) + key;
        this.going = {};
        engine.setKeys(this.taken, this.keys);
        if (scout?.tick > engine.tick)
            this.rewind(state => state.tick > engine.tick);
        else
            scout?.setKeys(this.taken, this.keys);
        this.step(engine);
    }

    /* Forget states, and play ahead from the last that is left. */
    rewind(isForgotten)
    {
        this.run++;
        this.states.forget(isForgotten);
        if (this.scout)
            this.restore(this.scout, this.states.list.at(-1));
    }

    /* Back to the session as it was given. */
    giveBack()
    {
        this.keys = "";
        this.rewind(state => state.isTaken);
        this.restore(this.engine, this.states.list.at(-1));
        this.taken = this.given - 1;
    }

    /* Open the session once more, for a view that shows sums over all ticks: the engine is then at tick 0. */
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

    /* The session with the keys that were played. */
    save()
    {
        return this.engine.session();
    }
}
