/* SPDX-License-Identifier: MIT */
/* drive_cloud.js - reports the picture of a cloud's page, measures between points and asks queries. */
"use strict";

const textsOf = root => [...root.querySelectorAll("h2, .fact")].map(part => part.textContent).join(" | ");

function click([x, y])
{
    const box = byId("stage").firstElementChild.getBoundingClientRect();
    interaction.live.pickAt({clientX: box.left + x / devicePixelRatio, clientY: box.top + y / devicePixelRatio});
}

const isInPicture = pixel => pixel.every((at, i) => at >= 0 && at < interaction.live.size[i]);

/* Click a point that no other element covers, and report whether it became the end of a measure. */
function sayClicked(engine)
{
    interaction.measure.stop();
    interaction.measure.toggle();
    for (let id = 0; id < 2000; id += 7) {
        const place = engine.point(id), pixel = place && engine.project([place])[0].map(Math.floor);
        if (pixel && isInPicture(pixel) && engine.pick(...pixel, 0).elements[0]?.point?.id === id) {
            click(pixel);
            say("clicked", interaction.measure.ends[0]?.id === id && !byId("measured").hidden);
            return;
        }
    }
    say("clicked", "no point is visible");
}

function sayMeasure(engine)
{
    actionOf("m")(octreel);
    interaction.measure.toggle();
    for (const id of [0, 100])
        interaction.measure.add({elements: [{point: {id}}]});
    say("measured", textsOf(byId("measured")));
    sayClicked(engine);
    interaction.measure.add({elements: []});
    say("no point", byId("status").textContent);
    interaction.goBack();
    say("after Esc", byId("measured").hidden && interaction.live.measured.length === 0);
}

function sayAsked(engine)
{
    const ids = () => JSON.parse(engine.facts()).answers.map(answer => answer.knearest?.neighbors ?? [answer.nearest ?? {}])
        .flat().map(({id}) => id);
    const asked = [];
    interaction.ask({knearest: 3, at: [3, 0, 0]});
    asked.push(JSON.stringify(ids()));
    interaction.ask();
    asked.push(JSON.stringify(ids()));
    interaction.ask({nearest: [3, 0, 0]});
    asked.push(JSON.stringify(ids()));
    say("asked", asked.join(" "));
}

async function drive()
{
    await interaction.start();
    await until(() => !interaction.busy, "the picture");
    const {engine} = player();
    say("pixels", digestOf(engine.draw().data));
    say("facts of the page", engine.facts() === octreel.recording.lines[0]);
    say("hidden", ["timeline", "transport"].map(id => getComputedStyle(byId(id)).display).join(" "));
    say("about", byId("about").textContent);
    say("keys", ["ArrowRight", "m"].map(key => actionOf(key) !== undefined).join(" "));
    interaction.live.drawNow();
    if (engine.view.color_points === "file") {
        sayMeasure(engine);
        sayAsked(engine);
    }
}

run(drive);
