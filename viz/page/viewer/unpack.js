/* SPDX-License-Identifier: MIT */
/* unpack.js - unpacks the compressed parts of a page, adds its styles, and runs its scripts. The content security policy
 * allows the unpacked texts by their hashes. */
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
    return new Response(new Blob([unpackLetters(letters)]).stream().pipeThrough(new DecompressionStream("gzip")));
}

async function addParts()
{
    const message = document.getElementById("message");
    if (typeof DecompressionStream !== "function") {
        message.textContent = "This browser lacks DecompressionStream, which the page needs. Use a newer browser. The " +
            "frames are PNG files beside the page, and ticks.jsonl holds what happened at each tick.";
        return;
    }
    for (const [id, name] of [["styles", "style"], ["scripts", "script"]]) {
        const part = document.createElement(name);
        part.textContent = await unpack(document.getElementById(id).textContent).text();
        document.body.append(part);
    }
}

addParts();
