// SPDX-License-Identifier: MIT
// A program that prints a session while it runs, with what its own index answers; here that is a scan of all points.
//
//     node brute.js | octreel record - -o flight && octreel audit flight
//
// With an argument the index is stale, where points were a tick before, and octreel audit says so.
let seed = 1;
const place = () => [0, 0, 0].map(() => (seed = (seed * 16807) % 2147483647) % 1801 - 900);
const say = (thing) => console.log(JSON.stringify(thing));

const points = new Map(Array.from({length: 100}, (_, n) => [n + 1, place()]));
say({octreel: "session", version: 2, player: null, points: [...points].map(([i, p]) => [...p, i])});
for (let tick = 1; tick <= 30; tick++) {
    const index = process.argv.length > 2 ? new Map(points) : points;
    const moved = [...points.keys()].filter((i) => i % 10 === tick % 10);
    for (const i of moved)
        points.set(i, place());
    const at = place();
    const found = [...index].map(([i, p]) => [i, p.reduce((sum, x, axis) => sum + (x - at[axis]) ** 2, 0)]);
    const nearest = found.reduce((best, one) => (one[1] < best[1] ? one : best));
    say({tick,
         edits: moved.map((i) => ({move: {id: i, position: points.get(i)}})),
         queries: [{nearest: at, answer: [nearest[0]]},
                   {radius: 500, at, answer: found.filter((one) => one[1] <= 500 ** 2).map((one) => one[0])}]});
}
