/* SPDX-License-Identifier: MIT */
/* engine.js - octreel's game and renderer as a WebAssembly module, and the saved states to which a session can go back.
 *
 * The module is octreel's own C code compiled for WebAssembly, from reading session.json to filling pixels; the page
 * does not imitate the program. It plays a session by itself and needs no recorded frames.
 *
 * JavaScript and C exchange little. Texts (the session, the view, a query; facts and picks as JSON) are copied as UTF-8
 * into a buffer that web_reserve_buffer() returns, and are read back from web_text(). Numbers pass as doubles. A
 * picture is the RGBA bytes at the address that web_draw() returns. C calls JavaScript only to parse JSON
 * (json_values.js). Every system call fails, because a page has no files. The functions are described in
 * module/module.c.
 *
 * The pixels equal those of the recorded PNGs; test_page_plays compares every tick. The integer rasterizer uses no GPU.
 * Scenes use double arithmetic that is the same bit for bit everywhere: WebAssembly specifies it, and the C code uses
 * no fused multiply-add and only exact functions of libm.
 *
 * All state is in the module's linear memory. A copy of this memory is therefore a state of the game, and the page goes
 * back to the state by copying the bytes back.
 */
"use strict";

const NO_FILE = 8; /* EBADF of WASI: the result of every system call, because a page has no files */

const moduleText = () => document.getElementById("module")?.textContent.trim();

/* Whether the page contains the module and the browser can run it. */
function hasModule()
{
    return Boolean(moduleText()) && typeof WebAssembly === "object";
}

/* The compiled module of the page; unpack.js compiles it. */
async function compileModule()
{
    try {
        return await compiled;
    } catch (error) {
        throw new Error(`the WebAssembly module in this page is damaged (${error.message}); record or copy the page ` +
                        "again");
    }
}

class Engine {
    constructor(module)
    {
        const imports = {};
        for (const {module: from, name} of WebAssembly.Module.imports(module))
            (imports[from] ??= {})[name] = () => NO_FILE;
        const json = new JsonValues(() => this.wasm.memory);
        imports.page = {parse_json: (text, size, alone, error) => json.parse(text >>> 0, size, alone, error >>> 0),
                        write_json: at => json.write(at >>> 0)};
        this.wasm = new WebAssembly.Instance(module, imports).exports;
        this.wasm._initialize?.();
        this.tick = -1; /* -1: no tick is played yet */
    }

    /* The module returns addresses as signed integers: those beyond 2 GiB are negative. */
    bytes(at, size)
    {
        return new Uint8Array(this.wasm.memory.buffer, at >>> 0, size >>> 0);
    }

    text()
    {
        return new TextDecoder().decode(this.bytes(this.wasm.web_text(), this.wasm.web_text_size()));
    }

    /* The text that a function of the module stored. Throws the text as an error if the function failed, so that `done`
     * is false. */
    textAfter(done)
    {
        if (!done)
            throw new Error(this.text());
        return this.text();
    }

    /* Write texts or bytes into the input buffer for the next call. Returns their sizes in bytes. */
    writeInput(...texts)
    {
        const parts = texts.map(text => typeof text === "string" ? new TextEncoder().encode(text) : text);
        const size = parts.reduce((sum, part) => sum + part.length, 0);
        let at = this.wasm.web_reserve_buffer(size) >>> 0;
        if (!at)
            throw new Error("out of memory");
        for (const part of parts) {
            this.bytes(at, part.length).set(part);
            at += part.length;
        }
        return parts.map(part => part.length);
    }

    /* Open a session. `points` is the block of the points of a cloud or of a large session, otherwise empty. */
    open(session, view, points = NO_POINTS)
    {
        this.textAfter(this.wasm.web_open(...this.writeInput(session, JSON.stringify(view), points), isCloud(points)));
        this.view = view;
        this.tick = 0;
        this.length = this.wasm.web_length() + 1;
    }

    /* Play the session's next tick, with `key` as the player's key press if it is not empty. */
    step(key)
    {
        this.textAfter(this.wasm.web_step(key ? key.charCodeAt(0) : 0));
        this.tick++;
    }

    facts()
    {
        return this.textAfter(this.wasm.web_facts()).trimEnd();
    }

    look(view)
    {
        this.textAfter(this.wasm.web_view(...this.writeInput(JSON.stringify(view))));
        this.view = view;
    }

    /* Whether the view shows sums over all ticks that were not collected, so that the session must be played again from
     * tick 0. */
    get lacksSums()
    {
        return Boolean(this.wasm.web_must_replay_for_heat());
    }

    /* Draw the current tick as recorded. The returned picture is valid until the next call of the module. */
    draw()
    {
        return this.picture(this.wasm.web_draw());
    }

    /* Draw the current tick with another size, without the column of text. `rows` becomes the JSON text of the rows of
     * this column. Letters and lines suit a picture of height `suited`. */
    drawAt(width, height, suited)
    {
        const picture = this.picture(this.wasm.web_draw_at(width, height, suited));
        this.rows = this.text();
        return picture;
    }

    picture(at)
    {
        if (!at)
            throw new Error(this.text());
        const [width, height] = this.size;
        return new ImageData(new Uint8ClampedArray(this.wasm.memory.buffer, at >>> 0, 4 * width * height), width, height);
    }

    /* The size of the last picture. */
    get size()
    {
        return [this.wasm.web_width(), this.wasm.web_height()];
    }

    digest()
    {
        return this.textAfter(this.wasm.web_digest());
    }

    camera()
    {
        return JSON.parse(this.textAfter(this.wasm.web_camera()));
    }

    /* The corners of the session's world. */
    world()
    {
        const at = new Float64Array(this.wasm.memory.buffer, this.wasm.web_world() >>> 0, 6);
        return {min: [...at.slice(0, 3)], max: [...at.slice(3)]};
    }

    choices()
    {
        return JSON.parse(this.textAfter(this.wasm.web_choices()));
    }

    pick(x, y, radius)
    {
        return JSON.parse(this.textAfter(this.wasm.web_pick(x, y, radius)));
    }

    /* Project positions in the world onto the picture. A position behind the camera becomes NaN. */
    project(places)
    {
        this.writeInput(new Uint8Array(new Float64Array(places.flat()).buffer));
        this.wasm.web_project(places.length);
        const numbers = new Float64Array(this.wasm.memory.buffer, this.wasm.web_reserve_buffer(0) >>> 0, 2 * places.length);
        return places.map((place, i) => [numbers[2 * i], numbers[2 * i + 1]]);
    }

    /* The ray through a pixel of the picture: its origin, and its direction with length 1. */
    ray(x, y)
    {
        const at = new Float64Array(this.wasm.memory.buffer, this.wasm.web_ray(x, y) >>> 0, 6);
        return {origin: [...at.slice(0, 3)], direction: [...at.slice(3)]};
    }

    /* The position of the point with this id, or null if there is no such point. */
    point(id)
    {
        const at = this.wasm.web_point(id);
        return at ? [...new Float64Array(this.wasm.memory.buffer, at >>> 0, 3)] : null;
    }

    /* An element of the tick by its name: "node 0/3", "foreign 12" or "point 7". Null if there is no such element. */
    describe(name)
    {
        return this.wasm.web_describe(...this.writeInput(name)) ? JSON.parse(this.text()) : null;
    }

    /* Answer queries at the current tick. The queries have the form of a session file. */
    ask(queries)
    {
        const text = JSON.stringify({octreel: "session", version: 2, queries});
        this.textAfter(this.wasm.web_ask(...this.writeInput(text)));
    }

    /* Replace the session's ticks after tick `last` by ticks with the player's key presses `keys`. */
    setKeys(last, keys)
    {
        this.writeInput(keys);
        this.textAfter(this.wasm.web_keys(last, keys.length));
        this.length = this.wasm.web_length() + 1;
    }

    /* The text of session.json for the session, with the user's key presses. */
    session()
    {
        return this.textAfter(this.wasm.web_session());
    }

    /* ---- States ----------------------------------------------------------------------------------------------- */

    used()
    {
        return this.bytes(0, this.wasm.web_used());
    }

    /* Go back to a state that was saved by an engine of the same module. The view does not change. */
    restore(state)
    {
        const view = this.view, missing = state.size - this.wasm.memory.buffer.byteLength;
        if (missing > 0)
            this.wasm.memory.grow(Math.ceil(missing / 65536));
        state.blocks.forEach((block, i) => this.bytes(i * BLOCK, block.length).set(block));
        this.tick = state.tick;
        this.length = this.wasm.web_length() + 1;
        if (view)
            this.look(view);
    }
}

const BLOCK = 4096;
const MOST_STATE_BYTES = 160 << 20;
const STATE_INTERVAL = 40; /* ms of playing between two saved states; going to a tick plays at most this long */

function divide(bytes)
{
    const blocks = [];
    for (let at = 0; at < bytes.length; at += BLOCK)
        blocks.push(bytes.subarray(at, at + BLOCK));
    return blocks;
}

/* Saved states of an engine, at some of its ticks. A state is a copy of the engine's memory, divided into blocks.
 * Blocks that did not change are shared with the previous state. When the states use too much memory, every second
 * state is dropped, and the interval between new states doubles. The first state copies all bytes at once, which is
 * three times as fast as copying them block by block. It is divided into blocks when the blocks are needed, after the
 * first picture. */
class States {
    constructor()
    {
        this.list = []; /* the states, in the order of their ticks */
        this.bytes = 0;
        this.interval = STATE_INTERVAL;
    }

    /* The last state at or before a tick, or null if there is none. */
    before(tick)
    {
        return this.list.findLast(state => state.tick <= tick) ?? null;
    }

    forget(isForgotten)
    {
        this.list = this.list.filter(state => !isForgotten(state));
        const blocks = new Set(this.list.flatMap(state => state.blocks));
        this.bytes = 0;
        for (const block of blocks)
            this.bytes += block.length;
    }

    /* Save a state of the engine. `isBranched`: the user's key presses are part of the state. */
    keep(engine, isBranched)
    {
        const bytes = engine.used(), last = this.list.at(-1), {tick} = engine, size = bytes.length;
        if (last) {
            this.list.push({tick, isBranched, size, blocks: this.changedBlocks(bytes, last)});
        } else {
            const copy = bytes.slice(), state = {tick, isBranched, size, get blocks() { return this.parts ??= divide(copy); }};
            this.list.push(state);
            this.bytes += size;
        }
        if (this.bytes <= MOST_STATE_BYTES || this.list.length < 3)
            return;
        const gone = new Set(this.list.filter((state, i) => i % 2 === 1));
        this.forget(state => gone.has(state));
        this.interval *= 2;
    }

    changedBlocks(bytes, last)
    {
        const blocks = [];
        for (let at = 0; at < bytes.length; at += BLOCK)
            blocks.push(this.block(bytes, at, last.blocks[at / BLOCK]));
        return blocks;
    }

    block(bytes, at, last)
    {
        const size = Math.min(BLOCK, bytes.length - at);
        if (last?.length === size && size === BLOCK) {
            const now = new BigUint64Array(bytes.buffer, at, BLOCK / 8);
            const then = new BigUint64Array(last.buffer, last.byteOffset, BLOCK / 8);
            let i = 0;
            while (i < now.length && now[i] === then[i])
                i++;
            if (i === now.length)
                return last;
        }
        this.bytes += size;
        return bytes.slice(at, at + size);
    }
}
