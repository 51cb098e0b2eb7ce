/* SPDX-License-Identifier: MIT */
/* engine.js - the program itself, as WebAssembly: it plays the session, draws its ticks and answers questions with the
 * code that recorded them. What each function does is said in viz/page/module/module.c. */
"use strict";

const NO_FILE = 8; /* EBADF: what every call of a system says, since a page has no files */

const moduleText = () => document.getElementById("module")?.textContent.trim();

/* Whether the page holds the module and the browser takes it. */
function hasModule()
{
    return Boolean(moduleText()) && typeof WebAssembly === "object" && typeof DecompressionStream === "function";
}

/* The bytes of such a text: what viz/page/module/pack_module makes. */
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
        throw new Error(`the program in this page is damaged (${error.message}); record or copy the page again`);
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
        this.tick = -1; /* none is played */
    }

    bytes(at, size)
    {
        return new Uint8Array(this.wasm.memory.buffer, at, size);
    }

    text()
    {
        return new TextDecoder().decode(this.bytes(this.wasm.web_text(), this.wasm.web_text_size()));
    }

    /* What a function says when it succeeds. */
    said(done)
    {
        if (!done)
            throw new Error(this.text());
        return this.text();
    }

    /* Leave texts where the next call reads them; their sizes in bytes. */
    give(...texts)
    {
        const parts = texts.map(text => typeof text === "string" ? new TextEncoder().encode(text) : text);
        const size = parts.reduce((sum, part) => sum + part.length, 0);
        let at = this.wasm.web_room(size);
        if (!at)
            throw new Error("there is no memory");
        for (const part of parts) {
            this.bytes(at, part.length).set(part);
            at += part.length;
        }
        return parts.map(part => part.length);
    }

    open(session, view)
    {
        this.said(this.wasm.web_open(...this.give(session, JSON.stringify(view))));
        this.view = view;
        this.tick = 0;
        this.length = this.wasm.web_length() + 1;
    }

    /* Play the next tick: the session's, or one by a key. */
    step(key)
    {
        this.said(this.wasm.web_step(key ? key.charCodeAt(0) : 0));
        this.tick++;
    }

    facts()
    {
        return this.said(this.wasm.web_facts()).trimEnd();
    }

    look(view)
    {
        this.said(this.wasm.web_view(...this.give(JSON.stringify(view))));
        this.view = view;
    }

    /* Whether the view shows sums over all ticks that the engine has not made. */
    get lacksSums()
    {
        return Boolean(this.wasm.web_lacks_sums());
    }

    /* The picture of the tick. */
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
        return this.said(this.wasm.web_digest());
    }

    camera()
    {
        return JSON.parse(this.said(this.wasm.web_camera()));
    }

    /* The world of the session. */
    world()
    {
        const at = new Float64Array(this.wasm.memory.buffer, this.wasm.web_world(), 6);
        return {min: [...at.slice(0, 3)], max: [...at.slice(3)]};
    }

    choices()
    {
        return JSON.parse(this.said(this.wasm.web_choices()));
    }

    pick(x, y, radius)
    {
        return JSON.parse(this.said(this.wasm.web_pick(x, y, radius)));
    }

    /* Pixels of the picture at which places of the world are seen; NaN where they are not. */
    project(places)
    {
        this.give(new Uint8Array(new Float64Array(places.flat()).buffer));
        this.wasm.web_project(places.length);
        const numbers = new Float64Array(this.wasm.memory.buffer, this.wasm.web_room(0), 2 * places.length);
        return places.map((place, i) => [numbers[2 * i], numbers[2 * i + 1]]);
    }

    /* Where the point of an id is, or null. */
    point(id)
    {
        const at = this.wasm.web_point(id);
        return at ? [...new Float64Array(this.wasm.memory.buffer, at, 3)] : null;
    }

    /* Ask queries about the tick that was played last, as session files have them. */
    ask(queries)
    {
        const text = JSON.stringify({octreel: "session", version: 2, queries});
        this.said(this.wasm.web_ask(...this.give(text)));
    }

    /* From now on the session is what it was up to a tick, and then these keys. */
    setKeys(last, keys)
    {
        this.give(keys);
        this.said(this.wasm.web_keys(last, keys.length));
        this.length = this.wasm.web_length() + 1;
    }

    /* The session as session.json. */
    session()
    {
        return this.said(this.wasm.web_session());
    }

    /* ---- States ----------------------------------------------------------------------------------------------- */

    used()
    {
        return this.bytes(0, this.wasm.web_used());
    }

    /* Go back to a state of an engine of the same module. The view is not part of what is played. */
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
const STATE_INTERVAL = 40; /* ms of playing from one state to the next: what going anywhere costs at most */

/* States of an engine at some of its ticks. A state is its memory in blocks, of which it shares those that are the same
 * as in the state before it. Where they become too many every other one goes, and the next are as far apart as those
 * that stay. */
class States {
    constructor()
    {
        this.list = []; /* by tick */
        this.bytes = 0;
        this.interval = STATE_INTERVAL;
    }

    /* The last state that is not after a tick; null when there is none. */
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

    /* `isTaken`: keys have changed the session. */
    keep(engine, isTaken)
    {
        const bytes = engine.used(), last = this.list.at(-1);
        const blocks = last ? this.changedBlocks(bytes, last) : this.copiedBlocks(bytes);
        this.list.push({tick: engine.tick, isTaken, size: bytes.length, blocks});
        if (this.bytes <= MOST_STATE_BYTES || this.list.length < 3)
            return;
        const gone = new Set(this.list.filter((state, i) => i % 2 === 1));
        this.forget(state => gone.has(state));
        this.interval *= 2;
    }

    /* All at once: copied one by one they take three times as long. */
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
