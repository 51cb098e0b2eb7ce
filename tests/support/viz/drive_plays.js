/* SPDX-License-Identifier: MIT */
/* drive_plays.js - plays the session of a recording in its page, in any order of ticks, like a user, and reports lines
 * "name<tab>value". */
"use strict";

async function sayTicks()
{
    const {length} = player();
    for (let i = 0; i < length; i++)
        await sayTick("tick", i * 101 % length);
}

function sayPicks()
{
    const {engine} = player();
    for (let i = 0; i < 40; i++) {
        const x = random(engine.view.size[0]), y = random(engine.view.size[1]);
        engine.pick(x, y, 3);
        say(`pick ${x} ${y}`, engine.text().trim());
    }
}

/* Sentences of a tick that the page plays, and elements that are selected by their names. */
async function sayTold()
{
    const textsOf = (root, what) => [...root.querySelectorAll(what)].map(({textContent}) => textContent).join(" | ");
    setOpen("sheet", true);
    for (const tick of [6, 225, 226]) {
        octreel.goTo(tick);
        await until(() => !interaction.busy && player().engine.tick === tick, `tick ${tick}`);
        say(`told ${tick}`, textsOf(byId("facts-of-tick"), ".happened"));
    }
    for (const name of ["node root", "node 7/7/7/0", "node 3/4", "point 6", "point 10", "foreign 3"]) {
        await octreel.inspector.select(name);
        say(`told ${name}`, textsOf(byId("picked"), "h2, p, dd"));
        say(`marked ${name}`, JSON.stringify(interaction.live.placeOfSubject()));
    }
    octreel.goTo(7);
    await until(() => !interaction.busy && player().engine.tick === 7, "tick 7");
    await octreel.inspector.select("query 1");
    say("told query 1", textsOf(byId("picked"), "h2, p, td"));
    octreel.address.write();
    say("address of query 1", location.hash);
    await octreel.inspector.select("query 2");
    say("told query 2", textsOf(byId("picked"), "h2, p"));
    octreel.goTo(226);
    await until(() => !interaction.busy && player().engine.tick === 226, "tick 226");
    await octreel.inspector.select("node 7/7/7/0");
    byId("picked").querySelector('[data-select="point 8"]').click();
    await until(() => byId("picked").textContent.startsWith("Point 8"), "point 8");
    byId("picked").querySelector('[data-select^="node"]').click();
    await until(() => byId("picked").textContent.startsWith("Leaf"), "its leaf");
    say("followed links", textsOf(byId("picked"), "h2"));
}

/* Queries are answered by the library, and disappear with the tick. */
async function sayAnswers()
{
    player().engine.draw(); /* as recorded */
    const digest = player().engine.digest();
    interaction.ask({knearest: 2, at: [0, 0, 0]});
    interaction.ask({radius: 100, at: [700, 700, 700]});
    const {answers} = JSON.parse(player().engine.facts());
    say("answer", JSON.stringify(answers.at(-1).radius.ids));
    for (const bounds of ["closed", "open"]) {
        const {form} = interaction;
        form.kind.value = "radius";
        Object.entries({at: "750,750,700", radius: "50", bounds}).forEach(
            ([name, value]) => form.inputs[name].input.value = value);
        interaction.ask(form.query());
        const answer = JSON.parse(player().engine.facts()).answers.at(-1).radius;
        say(`${bounds} ball`, JSON.stringify([answer.ids, answer.bounds]));
    }
    interaction.ask({range: {min: [1, 1, 1], max: [0, 0, 0]}});
    say("refused", byId("status").textContent);
    interaction.ask();
    player().engine.draw();
    say("asked nothing", player().engine.digest() === digest);
}

/* A ray through the pixel at which a point is drawn hits the point; the picture shows the ray. */
async function sayRay()
{
    const {engine} = player(), {live, form} = interaction;
    live.drawNow();
    const [width, height] = engine.size, places = [1, 2, 3, 4, 5, 7, 8, 9].map(id => [id, engine.point(id)]);
    const seen = places.filter(([, place]) => place).map(([id, place]) => [id, ...engine.project([place])[0].map(Math.floor)]);
    const [id, x, y] = seen.find(([, x, y]) => x >= 0 && y >= 0 && x < width && y < height);
    say("ray point", id);
    form.inputs.k.input.value = "9";
    interaction.showPick(engine.pick(x, y, 3), engine.point(id), {...engine.ray(x + 0.5, y + 0.5), thickness: 30});
    byId("shoot").click();
    say("ray query", interaction.asked);
    say("ray facts", engine.facts());
    say("ray title", byId("facts-of-tick").textContent.match(/First 9 hits of the ray from/g)?.length);
    live.drawNow();
    say("ray picture", engine.pick(x, y, 3).elements.filter(({text}) => text.includes("of the ray query")).length > 0);
    interaction.ask();
}

/* Report the buttons and the text of the bar. */
function sayBar(when)
{
    const [back, taken] = ["live-end", "branch"].map(id => byId(id).hidden ? "" : byId(id).textContent);
    say(`bar ${when}`, `${back}; ${taken}`);
}

async function sayTakenOver()
{
    sayBar("before");
    octreel.goTo(30);
    await until(() => !interaction.busy && player().engine.tick === 30, "tick 30");
    for (const key of "wwdnes.afnnq")
        await interaction.press(key);
    say("taken", `${octreel.tick} of ${octreel.last}`);
    octreel.goTo(35);
    await until(() => !interaction.busy && player().engine.tick === 35, "tick 35");
    await interaction.press("e");
    sayBar("taken");
    say("taken again", `${octreel.tick} of ${octreel.last}`);
    say("session", player().save().replaceAll("\n", " "));
    for (let tick = 0; tick <= octreel.last; tick++)
        await sayTick("taken", tick);
    interaction.goBack();
    say("given back", `${octreel.tick} of ${octreel.last}`);
    await interaction.start();
}

/* Random inputs: the page keeps working, and ticks stay the same. The script does not wait for pictures, because the
 * browser's clock would run ahead. */
function act()
{
    const gestures = [
        () => interaction.live.turn(random(200) - 100, random(200) - 100),
        () => interaction.live.move(random(200) - 100, random(200) - 100),
        () => interaction.live.zoom(0.5 + random(100) / 50, random(160), random(90)),
        () => interaction.live.look({camera: ["iso", "top", "follow", "orbit", "moon"][random(5)]}),
        () => interaction.live.look({slice: [undefined, {z: 100}, {w: 1}][random(3)]}),
        () => interaction.live.look({diagram: ["none", "beside", "only"][random(3)]}),
        () => interaction.live.look({depths: [undefined, [0, 2], [3, 1]][random(3)]}),
        () => interaction.live.lookAsRecorded(),
        () => player().engine.pick(random(160), random(90), 2),
        () => octreel.goTo(random(octreel.last + 1)),
        () => interaction.press("wsadefn."[random(8)]),
        () => interaction.ask({nearest: [random(1000), random(1000), NaN]}),
    ];
    gestures[random(gestures.length)]();
}

async function sayRandom()
{
    for (let i = 0; i < 600; i++) {
        act();
        await interaction.pressed;
    }
    await until(() => !interaction.busy, "the end of it");
    interaction.goBack();
    await interaction.start();
    for (let i = 0; i < 12; i++)
        await sayTick("again", random(octreel.last + 1));
}

/* Replies that come late find that the page no longer draws, or has other ticks. */
async function leaveMeanwhile()
{
    await interaction.start();
    const late = [interaction.zoom(2), interaction.turn(1, 1), interaction.pick()];
    interaction.goBack();
    await Promise.all(late);
    await interaction.ask({nearest: [0, 0, 0]});
    interaction.controls.change({labels: true});
    await interaction.start();
    octreel.goTo(octreel.last);
    const opened = interaction.open(new File(['{"octreel": "session", "version": 2, "ticks": 3}'], "short.json"));
    await until(() => octreel.recording !== interaction.recorded || octreel.last < 9, "the short session");
    octreel.show();
    await opened;
}

async function sayDropped(name, text, more = {})
{
    const before = player(), file = new File([text], name);
    await interaction.open(Object.defineProperties(file, more));
    say(`dropped ${name.includes("\n") ? "marked" : name}`, `${player() === before} ${byId("status").textContent}`);
}

/* A page without frames: its first picture without any input, and then inputs that leave it. */
async function driveAlone()
{
    const isShown = () => byId("stage").querySelector("canvas.live")?.dataset.tick === String(octreel.tick);
    await until(isShown, "a picture");
    say("begins", `${octreel.tick} ${byId("caption").hidden} ${byId("hint").hidden} ${byId("about").textContent}`);
    await until(() => player().scout?.tick === player().length - 1, "the end of the session");
    await sayTicks();
    sayBar("before");
    await interaction.live.look({labels: true});
    sayBar("looked at");
    await interaction.live.lookAsRecorded();
    octreel.goTo(octreel.last);
    await until(isShown, "the last picture");
    await interaction.press("w");
    sayBar("played on");
    interaction.goBack();
    await until(isShown, "a picture again");
    sayBar("given back");
    say("given back", `${interaction.isLive} ${octreel.last}`);
}

async function drive()
{
    if (!octreel.recording.hasFrames)
        return driveAlone();
    say("plays by itself", await interaction.start());
    const {wasm} = new Engine(interaction.module);
    say("begins with its memory in use", wasm.web_used() === wasm.memory.buffer.byteLength);
    await until(() => player().scout?.tick === player().length - 1, "the end of the session");
    await sayTicks();
    await player().goTo(219);
    player().engine.draw();
    sayPicks();
    await sayTold();
    octreel.goTo(219);
    await until(() => !interaction.busy && player().engine.tick === 219, "tick 219");
    await sayAnswers();
    await sayRay();
    await sayTakenOver();
    await sayRandom();
    await leaveMeanwhile();
    await sayDropped("frame.png", "\x89PNG\r\n");
    await sayDropped("newer.json", '{"octreel": "session", "version": 9}');
    await sayDropped("cut.json", '{"octreel": "session", "version": 2, "points": [[1, 2');
    await sayDropped("nan.json", '{"octreel": "session", "version": 2, "points": [[1, 2, NaN]]}');
    await sayDropped("cloud.json", '{"octreel": "session", "version": 2, "points": {"file": "utm.txt"}}');
    await sayDropped("huge.json", '{"octreel": "session", "version": 2, "points": [[1, 2, 1e999]]}');
    await sayDropped("label.json", '{"octreel": "session", "version": 2, "shapes": [{"label": "\u202eabc", "at": [0, 0, 0]}]}');
    await sayDropped("a\u202egnp\n.json", "");
    await sayDropped("binary", new Uint8Array(4096), {size: {value: 200 << 20}});
    await sayDropped("large.json", "{", {size: {value: 300 << 20}});
    await sayDropped("folder", "{", {slice: {value: () => ({text: () => Promise.reject(new Error("no file"))})}});
    await sayDropped("ticks.json", '{"octreel": "session", "version": 2, "ticks": 1000000000, "keys": "ww"}');
    say("long", `${player().length} ${player().engine.length}`);
    await sayDropped("text.json", '{"octreel": "session", "version": 2, "shapes": [{"label": "<\/script><b>", "at": [0, 0, 0]}]}');
    await sayDropped("good.json", '{"octreel": "session", "version": 2, "points": [[1, 2, 3]], "keys": "ww"}');
    await until(() => octreel.recording.length === 3, "the ticks of the session that was dropped");
    say("dropped", `${octreel.last} ${octreel.recording.tick(2).player}`);
}

run(drive);
