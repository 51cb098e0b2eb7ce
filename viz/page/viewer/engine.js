/* SPDX-License-Identifier: MIT */
/* engine.js - octreel's game and its drawing as a WebAssembly module, and states that a session can go back to.
 *
 * The page does not imitate the program: the module is the same C, from reading session.json to filling pixels,
 * compiled for WebAssembly. It plays a session by itself and needs no recorded frame. Few things cross the border: texts (the
 * session, the view, a query; facts and picks as JSON) are copied as UTF-8 into a buffer that web_reserve_buffer() gives and are
 * read back from web_text(); numbers pass as doubles; and a picture is the RGBA bytes at the address that web_draw()
 * returns. C calls JavaScript only to parse JSON (json_values.js); every system call fails, as a page has no files.
 *
 * Its pixels equal those of the recorded PNGs: the integer rasterizer uses no GPU, scenes come from double arithmetic
 * that IEEE 754 and the C code fix bit by bit (no fused multiply-add, no libm beyond exact functions), and WebAssembly
 * specifies that arithmetic. test_page_plays compares every tick. Since all state is in the module's linear memory, a
 * copy of that memory is a state of the game: going back copies it in again. Functions are described in
 * module/module.c. */
"use strict";

const NO_FILE = 8; /* EBADF of WASI: every system call returns it, as a page has no files */

const moduleText = () => document.getElementById("module")?.textContent.trim();

/* Whether the page holds the module and the browser can run it. */
function hasModule()
{
    return Boolean(moduleText()) && typeof WebAssembly === "object" && typeof DecompressionStream === "function";
}

/* Decode a text that module/pack_module wrote: Z85 with some digits replaced. */
function unpackLetters(text)
{
    const digits = new Map([..."0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?,_>()[]{}~%$#"]
        .map((letter, digit) => [letter, digit]));
    const words = new DataView(new ArrayBuffer(Math.floor(text.length / 5) * 4));
    for (let at = 0; at < words.byteLength; at += 4) {
        let word = 0;
        for (const letter of text.substr(1 + at / 4 * 5, 5))
            word = word * 85 + digits.get(letter);
        words.setUint32(at, word);
    }
    return new Uint8Array(words.buffer, 0, words.byteLength - text[0]);
}

/* The module, compiled. */
async function compileModule()
{
    try {
        const unpacked = new Blob([unpackLetters(moduleText())]).stream().pipeThrough(new DecompressionStream("gzip"));
        return await WebAssembly.compile(await new Response(unpacked).arrayBuffer());
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
        imports.page = {parse_json: (...text) => json.parse(...text), write_json: at => json.write(at)};
        this.wasm = new WebAssembly.Instance(module, imports).exports;
        this.wasm._initialize?.();
        this.tick = -1; /* no tick is played yet */
    }

    bytes(at, size)
    {
        return new Uint8Array(this.wasm.memory.buffer, at, size);
    }

    text()
    {
        return new TextDecoder().decode(this.bytes(this.wasm.web_text(), this.wasm.web_text_size()));
    }

    /* The text that a function left; throws its error if it failed. */
    textAfter(done)
    {
        if (!done)
            throw new Error(this.text());
        return this.text();
    }

    /* Write texts or bytes for the next call. Returns their sizes in bytes. */
    writeInput(...texts)
    {
        const parts = texts.map(text => typeof text === "string" ? new TextEncoder().encode(text) : text);
        const size = parts.reduce((sum, part) => sum + part.length, 0);
        let at = this.wasm.web_reserve_buffer(size);
        if (!at)
            throw new Error("out of memory");
        for (const part of parts) {
            this.bytes(at, part.length).set(part);
            at += part.length;
        }
        return parts.map(part => part.length);
    }

    open(session, view)
    {
        this.textAfter(this.wasm.web_open(...this.writeInput(session, JSON.stringify(view))));
        this.view = view;
        this.tick = 0;
        this.length = this.wasm.web_length() + 1;
    }

    /* Play the session's next tick, or a key. */
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

    /* Whether the view shows sums over all ticks that were not collected since tick 0. */
    get lacksSums()
    {
        return Boolean(this.wasm.web_lacks_sums());
    }

    /* Draw the tick. The picture is valid until the next call. */
    draw()
    {
        const at = this.wasm.web_draw();
        if (!at)
            throw new Error(this.text());
        const width = this.wasm.web_width(), height = this.wasm.web_height();
        return new ImageData(new Uint8ClampedArray(this.wasm.memory.buffer, at, 4 * width * height), width, height);
    }

    digest()
    {
        return this.textAfter(this.wasm.web_digest());
    }

    camera()
    {
        return JSON.parse(this.textAfter(this.wasm.web_camera()));
    }

    /* The session's world. */
    world()
    {
        const at = new Float64Array(this.wasm.memory.buffer, this.wasm.web_world(), 6);
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

    /* The pixels of places in the world; NaN for a place behind the camera. */
    project(places)
    {
        this.writeInput(new Uint8Array(new Float64Array(places.flat()).buffer));
        this.wasm.web_project(places.length);
        const numbers = new Float64Array(this.wasm.memory.buffer, this.wasm.web_reserve_buffer(0), 2 * places.length);
        return places.map((place, i) => [numbers[2 * i], numbers[2 * i + 1]]);
    }

    /* The position of the point with an id, or null. */
    point(id)
    {
        const at = this.wasm.web_point(id);
        return at ? [...new Float64Array(this.wasm.memory.buffer, at, 3)] : null;
    }

    /* Answer queries, written as in a session file, at the current tick. */
    ask(queries)
    {
        const text = JSON.stringify({octreel: "session", version: 2, queries});
        this.textAfter(this.wasm.web_ask(...this.writeInput(text)));
    }

    /* Replace the session's ticks after `last` by keys. */
    setKeys(last, keys)
    {
        this.writeInput(keys);
        this.textAfter(this.wasm.web_keys(last, keys.length));
        this.length = this.wasm.web_length() + 1;
    }

    /* The session as session.json. */
    session()
    {
        return this.textAfter(this.wasm.web_session());
    }

    /* ---- States ----------------------------------------------------------------------------------------------- */

    used()
    {
        return this.bytes(0, this.wasm.web_used());
    }

    /* Go back to a state of an engine of the same module. The view stays. */
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
const STATE_INTERVAL = 40; /* ms of playing between two states: the most that going to a tick costs */

/* States of an engine at some of its ticks. A state is a copy of the engine's memory in blocks; blocks that did not
 * change are shared with the state before it. When the states grow too large, every other one is dropped and the
 * interval between new ones doubles. */
class States {
    constructor()
    {
        this.list = []; /* by tick */
        this.bytes = 0;
        this.interval = STATE_INTERVAL;
    }

    /* The last state at or before a tick, or null. */
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

    /* Save a state. `isBranched`: the user's keys are part of it. */
    keep(engine, isBranched)
    {
        const bytes = engine.used(), last = this.list.at(-1);
        const blocks = last ? this.changedBlocks(bytes, last) : this.copiedBlocks(bytes);
        this.list.push({tick: engine.tick, isBranched, size: bytes.length, blocks});
        if (this.bytes <= MOST_STATE_BYTES || this.list.length < 3)
            return;
        const gone = new Set(this.list.filter((state, i) => i % 2 === 1));
        this.forget(state => gone.has(state));
        this.interval *= 2;
    }

    /* One copy of all: copying block by block takes three times as long. */
    copiedBlocks(bytes)
    {
        const copy = bytes.slice(), blocks = [];
        for (let at = 0; at < copy.length; at += BLOCK)
            blocks.push(copy.subarray(at, at + BLOCK));
        this.bytes += copy.length;
        return blocks;
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
