/* SPDX-License-Identifier: MIT */
/* unpack.js - unpacks the compressed parts of a page, adds its styles, and runs its scripts. The content security policy
 * allows the unpacked texts by their hashes. All parts are unpacked at the same time, and the browser compiles the
 * WebAssembly module while the scripts run: that saves a tenth of the time until the first picture. */
"use strict";

/* Decode a text that module/pack_module encoded: Z85 with some digits replaced. */
function unpackLetters(text)
{
    const digits = new Uint8Array(128); /* by the code of the letter: the points of a cloud have millions of letters */
    [..."0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?,_>()[]{}~%$#"]
        .forEach((letter, digit) => digits[letter.charCodeAt(0)] = digit);
    const words = new DataView(new ArrayBuffer(Math.floor(text.length / 5) * 4));
    for (let at = 0, from = 1; at < words.byteLength; at += 4) {
        let word = 0;
        for (const end = from + 5; from < end; from++)
            word = word * 85 + digits[text.charCodeAt(from)];
        words.setUint32(at, word);
    }
    return new Uint8Array(words.buffer, 0, words.byteLength - text[0]);
}

/* Decompress a text that module/pack_module encoded. Returns a Response, whose bytes or text can be awaited. */
function unpack(letters)
{
    const gzip = new DecompressionStream("gzip"), writer = gzip.writable.getWriter();
    for (const done of [writer.write(unpackLetters(letters)), writer.close()])
        done.catch(() => {}); /* the code that awaits the Response gets the error */
    return new Response(gzip.readable);
}

const lettersOf = id => document.getElementById(id)?.textContent.trim() ?? "";

async function compileText(text)
{
    return WebAssembly.compile(await unpack(text).arrayBuffer());
}

/* The text of the facts, and promises of the compiled module and of the bytes of the page's block of points if there is
 * one. */
let unpackedFacts, compiled, unpackedPoints;

async function addParts()
{
    const message = document.getElementById("message");
    if (typeof DecompressionStream !== "function") {
        message.textContent = "This browser lacks DecompressionStream, which the page needs. Use a newer browser. The " +
            "frames are PNG files beside the page, and ticks.jsonl holds what happened at each tick.";
        return;
    }
    const parts = [["styles", "style"], ["scripts", "script"]].map(([id, name]) => [name, unpack(lettersOf(id)).text()]);
    const facts = unpack(lettersOf("facts")).text();
    if (typeof WebAssembly === "object")
        (compiled = compileText(lettersOf("module"))).catch(() => {}); /* the awaiting code gets the error */
    if (lettersOf("points"))
        (unpackedPoints = unpack(lettersOf("points")).arrayBuffer()).catch(() => {});
    unpackedFacts = await facts;
    for (const [name, text] of parts) {
        const part = document.createElement(name);
        part.textContent = await text;
        document.body.append(part);
    }
}

addParts();
