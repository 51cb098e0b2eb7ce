/* SPDX-License-Identifier: MIT */
/* drive_packed.js - plays the ticks of a page whose points are packed, and saves its session. */
"use strict";

run(async () => {
    await interaction.start();
    say("packed", `${byId("session").textContent.includes('"points": []')} ${player().points.length > 0} ${player().isCloud}`);
    await until(() => player().scout?.tick === player().length - 1, "the last tick");
    for (let i = 0; i < player().length; i++)
        await sayTick("tick", i * 3 % player().length);
    say("session", player().save().replaceAll("\n", " "));
});
