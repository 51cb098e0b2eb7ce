/* SPDX-License-Identifier: MIT */
/* drive_reads.js - opens each text of `given` as a session, and reports the session that was read or the error. */
"use strict";

function readByPage(engine, text)
{
    try {
        engine.open(text, octreel.recording.about);
        return engine.session().replaceAll("\n", " ");
    } catch (error) {
        return `refused: ${error.message}`;
    }
}

run(async () => {
    await interaction.start();
    const engine = new Engine(interaction.module);
    given.forEach((text, i) => say(`text ${i}`, readByPage(engine, text)));
});
