/* SPDX-License-Identifier: MIT */
/* json_values.js - JSON for the WebAssembly module. JSON.parse() reads a text, and the value is written into the
 * module's memory as the structures of module/json_values.c. Numbers need no conversion, because JavaScript's numbers
 * are doubles too. JSON.parse() accepts some texts that octreel's own reader refuses; they are refused here. */
"use strict";

const VALUE_SIZE = 16, ENTRY_SIZE = 20;
/* The values of jansson's enumeration json_type. */
const JSON_TYPES = {object: 0, array: 1, string: 2, number: 4, true: 5, false: 6, null: 7};
/* Offsets and a size in jansson's structure json_error_t. */
const ERROR_POSITION = 8, ERROR_TEXT = 92, ERROR_TEXT_SIZE = 160;
const MOST_NESTED = 200;

/* What a byte of JSON outside a string may be, as bits. Most bytes are digits, which are none of these. */
const QUOTE = 1, COLON = 2, OPENING = 4, CLOSING = 8, ENDING = 16;
const BACKSLASH = "\\".charCodeAt(0);
const BYTE_KINDS = new Uint8Array(256);
for (const [chars, kind] of [['"', QUOTE], [":", COLON], ["[{", OPENING], ["]}", CLOSING | ENDING], [", \t\r\n", ENDING]])
    for (const char of chars)
        BYTE_KINDS[char.charCodeAt(0)] = kind;

/* The room for a text with its final zero: UTF-8 takes up to three bytes for each UTF-16 unit. */
const sizeOfText = text => 3 * text.length + 1;
const aligned = size => (size + 7) & ~7;

/* Find the end of the JSON value with which the bytes begin, by its brackets and quotes alone. Also counts the members
 * in the value, by its colons outside strings. */
function findJsonEnd(bytes)
{
    let depth = 0, members = 0;
    for (let at = 0; at < bytes.length; at++) {
        const kind = BYTE_KINDS[bytes[at]];
        if (kind === 0)
            continue;
        if (depth === 0 && kind & ENDING)
            return {end: at, members};
        if (kind === OPENING && ++depth > MOST_NESTED)
            throw new SyntaxError(`lists and objects nest more than ${MOST_NESTED} deep`);
        if (kind === QUOTE)
            for (at++; at < bytes.length && BYTE_KINDS[bytes[at]] !== QUOTE; at++)
                at += bytes[at] === BACKSLASH;
        members += kind === COLON;
        depth -= kind & CLOSING ? 1 : 0;
        if (depth === 0 && kind & (QUOTE | CLOSING))
            return {end: at + 1, members};
    }
    return {end: bytes.length, members};
}

/* Throw an error if octreel's own reader would refuse the value. Returns the number of bytes that the value needs in
 * addition to its own structure. Adds the number of its members to counts.members. */
function checkJson(value, counts)
{
    if (value === Infinity || value === -Infinity)
        throw new SyntaxError("a number is too large for a double");
    if (typeof value === "string" && /\0|\p{Surrogate}/u.test(value))
        throw new SyntaxError("a text holds \\u0000 or half of a surrogate pair");
    if (typeof value === "string")
        return aligned(sizeOfText(value));
    if (value === null || typeof value !== "object")
        return 0;
    let size = 0;
    if (Array.isArray(value)) {
        for (const item of value)
            size += VALUE_SIZE + checkJson(item, counts);
        return size;
    }
    for (const [key, member] of Object.entries(value)) {
        counts.members++;
        size += ENTRY_SIZE + 4 + checkJson(key, counts) + checkJson(member, counts);
    }
    return size;
}

/* The line of a syntax error. Some browsers report the line. Others quote ten characters on each side of the error. If
 * neither is found, the text ended early. */
function findErrorLine(source, message)
{
    const [, line] = /line (\d+)/.exec(message) ?? [], [, near] = /"(.*)"[.]* is not valid JSON/s.exec(message) ?? [];
    return line ?? source.slice(0, near === undefined ? source.length : source.indexOf(near) + 10).split("\n").length;
}

class JsonValues {
    /* `memory()` returns the module's memory, which may grow between two calls. */
    constructor(memory)
    {
        this.memory = memory;
    }

    /* The function page_parse_json() that json_values.c calls. */
    parse(text, size, alone, error)
    {
        const {buffer} = this.memory(), bytes = new Uint8Array(buffer, text, size), counts = {members: 0};
        let source = "";
        try {
            const {end, members} = findJsonEnd(bytes);
            source = new TextDecoder().decode(bytes.subarray(0, alone ? size : end));
            this.value = JSON.parse(source);
            const room = VALUE_SIZE + checkJson(this.value, counts);
            if (counts.members < members)
                throw new SyntaxError("a name occurs twice in an object");
            new DataView(buffer).setUint32(error + ERROR_POSITION, end, true);
            return room;
        } catch ({message}) {
            new DataView(buffer).setUint32(error, findErrorLine(source, message), true);
            this.writeText(error + ERROR_TEXT, message.replace(/^JSON\.parse: |( in JSON)? at (line|position) .*$/g, ""),
                           ERROR_TEXT_SIZE);
            return 0;
        }
    }

    /* The function page_write_json() that json_values.c calls. */
    write(at)
    {
        this.out = new DataView(this.memory().buffer);
        this.next = at + VALUE_SIZE;
        this.writeValue(at, this.value);
        this.value = this.out = null;
    }

    /* Write a text with a final zero. Returns the size of the text in bytes, without the zero. */
    writeText(at, text, size = sizeOfText(text))
    {
        const bytes = new Uint8Array(this.memory().buffer, at, size);
        const {written} = new TextEncoder().encodeInto(text, bytes.subarray(0, size - 1));
        bytes[written] = 0;
        return written;
    }

    writeValue(at, value)
    {
        const type = value === null ? "null" : Array.isArray(value) ? "array" : typeof value;
        this.out.setUint32(at, JSON_TYPES[type] ?? JSON_TYPES[value], true);
        this.out.setUint32(at + 4, 1, true); /* the reference count of the value */
        if (type === "number")
            this.out.setFloat64(at + 8, value, true);
        else if (type === "string")
            this.out.setUint32(at + 8, this.writeText(this.point(at + 12, sizeOfText(value)), value), true);
        else if (type === "array")
            this.writeArray(at, value);
        else if (type === "object")
            this.writeObject(at, Object.entries(value));
    }

    /* Reserve `size` bytes and set the pointer at the address `link` to them. Returns their address. */
    point(link, size)
    {
        const at = this.next;
        this.next += aligned(size);
        this.out.setUint32(link, at, true);
        return at;
    }

    writeArray(at, items)
    {
        const first = this.point(at + 12, VALUE_SIZE * items.length);
        this.out.setUint32(at + 8, items.length, true);
        items.forEach((item, i) => this.writeValue(first + VALUE_SIZE * i, item));
    }

    writeObject(at, entries)
    {
        this.out.setUint32(at + 8, entries.length, true);
        let link = at + 12;
        for (const [key, member] of entries) {
            const entry = this.point(link, ENTRY_SIZE + sizeOfText(key));
            link = entry + VALUE_SIZE;
            this.out.setUint32(link, 0, true);
            this.writeText(entry + ENTRY_SIZE, key);
            this.writeValue(entry, member);
        }
    }
}
