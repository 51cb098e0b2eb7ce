/* SPDX-License-Identifier: MIT */
/* drive_frames.js - times the page that it is behind of, FRAMES of its ticks long, and says what it found in one line
 * of the console. */

const SCRUBS = Math.min(FRAMES, 30);
const {interaction} = octreel;

const rest = ms => new Promise(done => setTimeout(done, ms));

/* The browser's own start is not the page's: the page is timed when it is loaded once more. */
async function loadAgain()
{
    if (sessionStorage.getItem("again"))
        return;
    sessionStorage.setItem("again", "yes");
    await rest(200);
    location.reload();
    await new Promise(() => {});
}

/* As the slider does: the picture, the facts and the marks. */
async function show(tick)
{
    octreel.goTo(tick);
    do
        await interaction.live.draw();
    while (interaction.player.engine.tick !== tick);
}

/* Milliseconds a frame, ticks in order, with all that the browser does until it takes the next. */
async function timeFrames()
{
    const {length} = interaction.player, start = performance.now();
    for (let i = 1; i <= FRAMES; i++)
        await show(i % length);
    return (performance.now() - start) / FRAMES;
}

/* Milliseconds until a frame is drawn and given to the browser. */
async function timeDrawing()
{
    const {player, live} = interaction, start = performance.now();
    for (let i = 1; i <= FRAMES; i++) {
        await player.goTo(i % player.length);
        live.drawNow();
    }
    return (performance.now() - start) / FRAMES;
}

/* The longest way to a tick at random, once the page has played ahead. */
async function timeScrubbing()
{
    const {player} = interaction;
    while (player.scout && player.scout.tick + 1 < player.length)
        await rest(5);
    let longest = 0;
    for (let i = 0, seed = 1; i < SCRUBS; i++) {
        seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
        const start = performance.now();
        await show(Math.floor(seed / 2 ** 32 * player.length));
        longest = Math.max(longest, performance.now() - start);
    }
    return longest;
}

/* The browser counts buffers as JavaScript's, but not the memories of modules. */
function countMemory()
{
    const {engine, scout} = interaction.player;
    return [engine, scout].reduce((sum, each) => sum + (each?.wasm.memory.buffer.byteLength ?? 0),
                                  performance.memory.usedJSHeapSize);
}

async function measure()
{
    await loadAgain();
    if (!await interaction.start())
        return `left out: ${document.getElementById("told").textContent}`;
    const first = performance.now();
    const frame = await timeFrames(), draw = await timeDrawing(), scrub = await timeScrubbing();
    return `first ${first} frame ${frame} draw ${draw} scrub ${scrub} bytes ${countMemory()} `;
}

console.log(`octreel-bench: ${await measure().catch(error => `left out: ${error.message}`)}`);
