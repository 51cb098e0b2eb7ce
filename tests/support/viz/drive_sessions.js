/* SPDX-License-Identifier: MIT */
/* drive_sessions.js - plays sessions (`given`, with their views) in any order of ticks, clicks in them, and continues
 * to play from them. */
"use strict";

const PICK_RADIUS_ASKED = 2, TURNS = 3, MOST_KEYS = 12;

const play = ({session, view}) => interaction.play(session, view, new Recording(view, []));

async function sayPlayed({name, session, view, ticks, clicks})
{
    await play({session, view});
    if (!ticks.length)
        await until(() => player().scout?.tick === player().length - 1, `the end of ${name}`);
    const wanted = ticks.length ? ticks : [...Array(player().length).keys()];
    for (let i = 0; i < wanted.length; i++) {
        const tick = wanted[i * 101 % wanted.length];
        await sayTick(name, tick);
        for (let click = 0; click < clicks; click++) {
            const x = random(view.size[0]), y = random(view.size[1]);
            player().engine.pick(x, y, PICK_RADIUS_ASKED);
            say(`pick ${name} ${tick} ${x} ${y}`, player().engine.text().trim());
        }
    }
}

/* Continue to play several times, from any tick, also from ticks played before, and report the saved session. */
async function sayTaken({name, session, view})
{
    await play({session, view});
    for (let turn = 0; turn < TURNS; turn++) {
        await until(() => octreel.recording.length === player().length, "the ticks that are known");
        octreel.goTo(random(octreel.last + 1));
        for (let keys = 1 + random(MOST_KEYS); keys > 0; keys--)
            await interaction.press("wsadefn."[random(8)]);
    }
    say(`saved ${name}`, player().save().replaceAll("\n", " "));
    for (let tick = octreel.last; tick >= 0; tick--)
        await sayTick(`taken ${name}`, tick);
    interaction.goBack();
    await interaction.start();
}

run(async () => {
    await interaction.start();
    for (const one of given.filter(({taken}) => !taken))
        await sayPlayed(one);
    for (const one of given.filter(({taken}) => taken))
        await sayTaken(one);
});
