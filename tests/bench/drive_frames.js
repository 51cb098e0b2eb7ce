/* SPDX-License-Identifier: MIT */
/* drive_frames.js - runs behind a page, times FRAMES of its ticks, and prints the results in a line of the console. */

const SCRUBS = Math.min(FRAMES, 30);
const {interaction} = octreel;

const rest = ms => new Promise(done => setTimeout(done, ms));

/* The page is timed when it is loaded a second time, without the start of the browser. */
async function loadAgain()
{
    if (sessionStorage.getItem("again"))
        return;
    sessionStorage.setItem("again", "yes");
    await rest(200);
    location.reload();
    await new Promise(() => {});
}

/* Show a tick as the slider does: picture, facts and marks. */
async function show(tick)
{
    octreel.goTo(tick);
    do
        await interaction.live.draw();
    while (interaction.player.engine.tick !== tick);
}

/* Milliseconds per frame, for ticks in order, with all work of the browser. */
async function timeFrames()
{
    const {length} = interaction.player, start = performance.now();
    for (let i = 1; i <= FRAMES; i++)
        await show(i % length);
    return (performance.now() - start) / FRAMES;
}

/* Milliseconds to draw a frame and pass it to the browser. */
async function timeDrawing()
{
    const {player, live} = interaction, start = performance.now();
    for (let i = 1; i <= FRAMES; i++) {
        await player.goTo(i % player.length);
        live.drawNow();
    }
    return (performance.now() - start) / FRAMES;
}

/* The longest time to reach a random tick after the page has played ahead. */
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

/* Milliseconds per frame while the view turns in a window of a size, with all work of the browser. If isFull is false,
 * the page may draw fewer pixels. Also returns the scale of the last picture. */
async function timeTurning(window, isFull)
{
    const {live} = interaction, frames = Math.min(FRAMES, 120);
    Object.defineProperty(live, "size",
                          {get: () => window.map(side => Math.round(side * live.scale)), configurable: true});
    live.drawNow();
    await rest(200);
    const start = performance.now();
    for (let i = 0; i < frames; i++) {
        if (isFull)
            live.cost = 0;
        live.turnStep(1, 0);
        await live.draw();
    }
    return [(performance.now() - start) / frames, live.scale];
}

/* The browser's count of JavaScript memory includes buffers, but not the memories of modules. */
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
        return `left out: ${document.getElementById("status").textContent}`;
    const first = performance.now();
    const frame = await timeFrames(), draw = await timeDrawing(), scrub = await timeScrubbing(), bytes = countMemory();
    const turn = [];
    for (const size of SIZES)
        turn.push((await timeTurning(size, true))[0], ...await timeTurning(size, false));
    return `first ${first} frame ${frame} draw ${draw} scrub ${scrub} turn ${turn.join(" ")} bytes ${bytes} `;
}

console.log(`octreel-bench: ${await measure().catch(error => `left out: ${error.message}`)}`);
