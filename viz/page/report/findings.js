/* SPDX-License-Identifier: MIT */
/* findings.js - the findings of a comparison, parsed from the page, and the sentences that describe them. */
"use strict";

const KINDS = {
    pixels: "pixels differ",
    size: "different size",
    digest: "different digest",
    no_frame: "no frame",
    no_reference: "no reference",
    unreadable: "unreadable",
};

const grouped = number => number.toLocaleString("en-US");
const pair = ([x, y]) => `${x}, ${y}`;
const sides = ([width, height]) => `${width} × ${height}`;

class Findings {
    constructor(text)
    {
        const lines = text.trim().split("\n").map(line => JSON.parse(line));
        this.whole = lines[0];
        this.frames = lines.slice(1);
        this.pictures = new Map();
        for (const image of document.getElementById("pictures").content.querySelectorAll("img"))
            this.pictures.set(`${image.dataset.frame} ${image.dataset.picture}`, image);
    }

    /* The data URL of a picture of a frame, or null if the page does not hold the picture. */
    picture(frame, which)
    {
        return this.pictures.get(`${frame} ${which}`)?.src ?? null;
    }

    indexOf(name)
    {
        return this.frames.findIndex(frame => frame.frame === name);
    }
}

/* The tally of the counted differences. If the finding has none, as for frames of different sizes, the tally of all
 * differences. */
function tallyOf(finding)
{
    return finding.counted?.pixels > 0 ? finding.counted : finding.unlike ?? {pixels: 0};
}

/* The title of a finding. All frames of a finding have the same difference; the page shows the pictures of the first of
 * these frames. */
function titleOf(finding)
{
    return finding.frames.length > 1 ? finding.frames_words : shortName(finding);
}

/* The short name of a frame: "tick 41" for frame_000041.png of a recording. Other files keep their names. */
function shortName(finding)
{
    const tick = /^frame_(\d+)\.png$/.exec(finding.frame);
    return tick ? `tick ${Number(tick[1])}` : finding.frame;
}

function shortWords(finding)
{
    const pixels = tallyOf(finding).pixels;
    if (finding.finding !== "pixels")
        return KINDS[finding.finding];
    return `${grouped(pixels)} ${pixels === 1 ? "pixel" : "pixels"}`;
}

/* Capitalize a text, unless it starts with the file name of a picture. */
const capital = text => /^[^;]*\.png /i.test(text) ? text : text.charAt(0).toUpperCase() + text.slice(1);

/* The headline of a finding: its cause or, if the cause is unknown, the amount of difference. It ends at the first
 * semicolon. */
function headlineOf(finding)
{
    return capital((finding.cause ?? finding.words).split("; ")[0]);
}

/* The headline of the report: the first frame that differs, and the cause if it is known. */
function headlineOfAll(whole, [first])
{
    const name = shortName(first);
    return [`${name === first.frame ? name : capital(name)} is the first frame that differs`,
            ...whole.headline ? [whole.headline] : []].join(": ");
}

/* The details of a finding: the part of the cause that the headline leaves out, and the difference itself if it is not
 * in pixels. */
function detailsOf(finding)
{
    const [, ...rest] = (finding.cause ?? "").split("; ");
    const details = rest.length > 0 ? [rest.join("; ")] : [];
    if (finding.cause && finding.finding !== "pixels")
        details.push(finding.words);
    return details.map(capital).join(". ");
}

function share(pixels, [width, height])
{
    const percent = 100 * pixels / (width * height);
    return percent < 0.01 ? "under 0.01\u202f%" : `${percent < 10 ? percent.toPrecision(2) : Math.round(percent)}\u202f%`;
}

function forgivenIn(finding)
{
    return [["close", "close"], ["antialiased", "anti-aliased"], ["ignored", "in ignored areas"]]
        .filter(([member]) => finding[member] > 0).map(([member, words]) => `${grouped(finding[member])} ${words}`);
}

/* Rows with the sizes of the two pictures; a single row if the sizes are equal. */
function sizesOf({reference_size: expected, frame_size: actual})
{
    const sizes = [["expected", expected], ["actual", actual]].filter(([, size]) => size);
    return expected && actual && sides(expected) === sides(actual) ? [["size", sides(expected)]] :
        sizes.map(([name, size]) => [name, sides(size)]);
}

/* The largest difference of a pixel, rounded up as in all reports, so that the shown number works as a tolerance. */
function shownDelta(delta)
{
    return (Math.ceil(delta * 1e4) / 1e4).toFixed(4);
}

/* The names and values of a finding that the panel shows. */
function factsOf(finding)
{
    const tally = tallyOf(finding), facts = [], forgiven = forgivenIn(finding);
    if (finding.frames.length > 1)
        facts.push(["same in", `${grouped(finding.frames.length)} frames: ${finding.frames_words}`]);
    if (tally.pixels > 0) {
        facts.push(["pixels", `${grouped(tally.pixels)} of ${grouped(finding.frame_size[0] * finding.frame_size[1])}, ` +
                              share(tally.pixels, finding.frame_size)]);
        facts.push(["worst", `${shownDelta(tally.worst_delta)} YIQ at ${pair(tally.worst_at)}`]);
        facts.push(["channels", `by up to ${tally.largest_channel} of ${finding.channel_range}`]);
        facts.push(["area", `${pair(tally.min)} to ${pair(tally.max)}`]);
    }
    if (finding.flip)
        facts.push(["FLIP", `mean ${shownDelta(finding.flip.mean)}, worst ${shownDelta(finding.flip.worst)}`]);
    if (forgiven.length > 0)
        facts.push(["forgiven", forgiven.join(", ")]);
    facts.push(...sizesOf(finding));
    if (finding.reference_digest)
        facts.push(["digests", `${finding.reference_digest} expected, ${finding.frame_digest} actual`]);
    return facts;
}
