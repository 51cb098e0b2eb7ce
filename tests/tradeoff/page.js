/* SPDX-License-Identifier: MIT */
/* page.js - draws the charts and tables of the trade's page from the JSON and CSV in the page.
 *
 * A chart shows series of points, each with a mark and a colour of its own. A chapter has one legend, which hides
 * series, and one list for each part of the names that are not series. Another page of octree-tradeoff can be laid over
 * this one; its points are hollow. */
"use strict";

const SVG = "http://www.w3.org/2000/svg";
const WIDTH = 440, HEIGHT = 320, LEFT = 62, RIGHT = 14, TOP = 10, BOTTOM = 52;
const COLORS = 12;

/* Make an element with attributes and children. */
function make(name, attributes = {}, ...children)
{
    const svg = ["svg", "path", "line", "text", "g", "title"].includes(name);
    const element = svg ? document.createElementNS(SVG, name) : document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        if (key.startsWith("on"))
            element.addEventListener(key.slice(2), value);
        else
            element.setAttribute(key, value);
    element.append(...children.filter(child => child !== null));
    return element;
}

/* ---- Figures ---------------------------------------------------------------------------------------------------- */

function readTable(page, name)
{
    const block = page.getElementById(`csv-${name}`);
    if (!block)
        return [];
    const [head, ...lines] = block.textContent.trim().split("\n").map(line => line.split(","));
    const names = ["", ""]; /* an empty name is that of the row before */
    return lines.map(line => Object.fromEntries(head.map((key, i) => [key, i < 2 ? names[i] = line[i] || names[i] : line[i] === "inf" ? Infinity : Number(line[i])])));
}

/* The notes of a chapter, {scene, variants, text}, or its pictures, {caption, png}. */
function readBlock(kind, name)
{
    return JSON.parse(document.getElementById(`${kind}-${name}`)?.textContent ?? "[]");
}

function readAbout(page)
{
    return JSON.parse(page.getElementById("about").textContent);
}

function unique(list)
{
    return [...new Set(list)];
}

/* The names of the libraries, in the page's order. */
const LIBRARIES = readAbout(document).libraries.split(", ").map(library => library.split(" ")[0]);

/* Sort the names of indexes in this order; other names keep theirs. */
function sortByLibrary(names)
{
    const place = name => LIBRARIES.indexOf(name) + 1 || LIBRARIES.length + 1;
    return names.sort((a, b) => place(a) - place(b));
}

/* A number for people: three digits, with k and M for thousands and millions. */
function shorten(value)
{
    const size = Math.abs(value);
    if (!Number.isFinite(value))
        return Number.isNaN(value) ? "–" : "∞";
    if (size !== 0 && (size >= 1e9 || size < 1e-3))
        return value.toExponential(2).replace(".00e", "e").replace("e+", "e");
    if (size >= 1e6)
        return `${Number((value / 1e6).toPrecision(3))} M`;
    if (size >= 1e4)
        return `${Number((value / 1e3).toPrecision(3))} k`;
    return String(Number(value.toPrecision(size >= 1 && size < 10 ? 5 : 4)));
}

/* ---- Axes ------------------------------------------------------------------------------------------------------- */

function linearTicks(low, high)
{
    const rough = (high - low) / 4 || 1, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find(factor => factor * power >= rough);
    const ticks = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; i++)
        ticks.push(i * step);
    return ticks;
}

function logTicks(low, high)
{
    const ticks = [], decades = Math.log10(high / low);
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high) + 1; power += Math.max(1, Math.ceil(decades / 6)))
        for (const factor of decades > 2.5 ? [1] : decades > 1.2 ? [1, 3] : [1, 2, 5])
            ticks.push(factor * 10 ** power);
    return ticks.filter(tick => tick >= low * 0.999 && tick <= high * 1.001);
}

/* An axis over all values, with a small margin: where a value lies from 0 to 1, and the ticks. */
function makeAxis(values, log)
{
    const used = values.filter(value => Number.isFinite(value) && (!log || value > 0));
    if (!used.length)
        return {at: () => 0.5, ticks: [], accepts: () => false};
    const scale = log ? Math.log : value => value;
    let low = Math.min(...used), high = Math.max(...used);
    if (low === high)
        [low, high] = log ? [low / 2, high * 2] : [low - 0.5, high + 0.5];
    const margin = (scale(high) - scale(low)) * 0.05;
    const from = scale(low) - margin, to = scale(high) + margin;
    return {
        at: value => (scale(value) - from) / (to - from),
        ticks: log ? logTicks(Math.exp(from), Math.exp(to)) : linearTicks(from, to),
        accepts: value => Number.isFinite(value) && (!log || value > 0),
    };
}

/* ---- Marks ------------------------------------------------------------------------------------------------------ */

const SHAPES = [
    "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0z", "M-3.6,-3.6h7.2v7.2h-7.2z", "M0,-5l5,8.5h-10z", "M0,-5.2l5.2,5.2l-5.2,5.2l-5.2,-5.2z",
    "M0,5l5,-8.5h-10z", "M-5,-1.6h3.4v-3.4h3.2v3.4h3.4v3.2h-3.4v3.4h-3.2v-3.4h-3.4z",
];

function drawMark(series, hollow)
{
    const color = `var(--s${series % COLORS})`;
    return make("path", {class: "mark", d: SHAPES[series % SHAPES.length], fill: hollow ? "none" : color, stroke: color, "stroke-width": 1.5});
}

/* ---- A chart ---------------------------------------------------------------------------------------------------- */

class Chart {
    constructor(chapter, about)
    {
        this.chapter = chapter;
        this.about = about;
        this.said = make("p", {class: "said", "aria-live": "polite"});
        this.svg = make("svg", {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, tabindex: 0, role: "application", "aria-label": `${about.title}. Arrow keys go from point to point.`,
                                onkeydown: event => this.step(event)});
        this.element = make("div", {class: "chart"}, make("h3", {}, about.title), this.svg, this.said);
    }

    place(row)
    {
        return [LEFT + this.x.at(row[this.about.x]) * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - this.y.at(row[this.about.y]) * (HEIGHT - TOP - BOTTOM)];
    }

    shows(row)
    {
        return this.x.accepts(row[this.about.x]) && this.y.accepts(row[this.about.y]);
    }

    /* Draw the rows that are shown. The bound of y is a line without marks. */
    draw(rows)
    {
        const {x, y, bound, xLog, yLog} = this.about;
        this.x = makeAxis(rows.map(row => row[x]), xLog);
        this.y = makeAxis(rows.flatMap(row => bound ? [row[y], row[bound]] : [row[y]]), yLog);
        this.rows = rows.filter(row => this.shows(row)).sort((a, b) => a.series - b.series || a.other - b.other || a.setting - b.setting);
        this.svg.replaceChildren(...this.drawAxes(), ...this.drawBound(rows), ...this.drawSeries());
        this.current = -1;
        this.said.textContent = this.rows.length ? "" : "There is nothing to draw with these choices.";
    }

    drawAxes()
    {
        const parts = [], bottom = HEIGHT - BOTTOM;
        for (const tick of this.x.ticks) {
            const x = LEFT + this.x.at(tick) * (WIDTH - LEFT - RIGHT);
            parts.push(make("line", {class: "grid", x1: x, x2: x, y1: TOP, y2: bottom}), make("text", {x, y: bottom + 16, "text-anchor": "middle"}, shorten(tick)));
        }
        for (const tick of this.y.ticks) {
            const y = bottom - this.y.at(tick) * (bottom - TOP);
            parts.push(make("line", {class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: y, y2: y}), make("text", {x: LEFT - 6, y: y + 4, "text-anchor": "end"}, shorten(tick)));
        }
        const short = label => label.length > 62 ? label.slice(0, 60) + "…" : label;
        parts.push(make("text", {x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 14, "text-anchor": "middle"}, short(this.about.xLabel)),
                   make("text", {transform: `translate(13,${(TOP + bottom) / 2}) rotate(-90)`, "text-anchor": "middle"}, this.about.yLabel.length > 48 ? this.about.yLabel.slice(0, 46) + "…" : this.about.yLabel));
        return parts;
    }

    drawBound(rows)
    {
        const {x, bound} = this.about;
        if (!bound)
            return [];
        const line = new Map(rows.filter(row => this.x.accepts(row[x]) && this.y.accepts(row[bound])).map(row => [row[x], row[bound]]));
        const path = [...line].sort((a, b) => a[0] - b[0]).map(([at, value]) => this.place({[x]: at, [this.about.y]: value}).join(",")).join("L");
        return path ? [make("path", {d: "M" + path, fill: "none", stroke: "var(--bound)", "stroke-width": 2}, make("title", {}, "proven bound"))] : [];
    }

    drawSeries()
    {
        const parts = [];
        this.marks = [];
        for (const key of unique(this.rows.map(row => `${row.series}/${row.other}`))) {
            const rows = this.rows.filter(row => `${row.series}/${row.other}` === key);
            const {series, other} = rows[0];
            parts.push(make("path", {d: "M" + rows.map(row => this.place(row).join(",")).join("L"), fill: "none", stroke: `var(--s${series % COLORS})`,
                                     "stroke-width": 1, "stroke-dasharray": other ? "3 3" : "none"}));
            for (const row of rows) {
                const mark = drawMark(series, other), number = this.marks.length;
                mark.setAttribute("transform", `translate(${this.place(row).join(",")})`);
                mark.addEventListener("pointerenter", () => this.tell(number));
                mark.addEventListener("click", () => this.tell(number));
                this.marks.push(mark);
                parts.push(mark);
            }
        }
        return parts;
    }

    /* Name a point, and make its mark larger. */
    tell(number)
    {
        const row = this.rows[number];
        this.marks[this.current]?.setAttribute("stroke-width", 1.5);
        this.current = number;
        this.marks[number].setAttribute("stroke-width", 5);
        const figures = this.chapter.columns.filter(column => Number.isFinite(row[column.name])).map(column => `${column.name} ${shorten(row[column.name])}`);
        this.said.textContent = `${row.variant}, ${row.scene}${row.other ? " (the other page)" : ""}: ${figures.join(", ")}`;
    }

    step(event)
    {
        const moves = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1};
        if (!(event.key in moves) || !this.rows.length)
            return;
        event.preventDefault();
        this.tell((Math.max(this.current, moves[event.key] > 0 ? -1 : 0) + moves[event.key] + this.rows.length) % this.rows.length);
    }
}

/* ---- A matrix --------------------------------------------------------------------------------------------------- */

const VERDICTS = ["right", "wrong", "refused", "hung", "crashed", "open"];

/* A table of scenes by variants. A cell says what an index did; a cell with a note opens it. */
class Matrix {
    constructor(chapter, about, rows, notes)
    {
        this.name = chapter.name;
        this.notes = notes;
        this.opened = make("div", {"aria-live": "polite"});
        const variants = sortByLibrary(unique(rows.map(row => row.variant)));
        const table = make("table", {class: "matrix"},
            make("tr", {}, ...["stress", "query", ...variants].map(name => make("th", {scope: "col"}, name))),
            ...unique(rows.map(row => row.scene)).map(scene => make("tr", {}, ...scene.split(" / ").map(part => make("td", {}, part)),
                ...variants.map(variant => this.cell(rows.find(row => row.scene === scene && row.variant === variant))))));
        this.element = make("div", {class: "chart"}, make("h3", {}, about.title),
            make("p", {}, "× 2: the worst neighbour is twice as far as the true one. −3 +4: over all answers, 3 points of the region are missing and 4 are outside of it. Open: right, if points exactly on the boundary do not belong to a region. Click a wrong answer for a session that shows it."),
            make("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": about.title}, table), this.opened);
    }

    cell(row)
    {
        if (!row)
            return make("td", {class: "none", title: "the index has no such query"}, "·");
        const verdict = VERDICTS[row.verdict];
        const much = row.excess > 0 ? ` × ${row.excess < 1e-4 ? "1 + " + shorten(row.excess) : shorten(1 + row.excess)}` : row.missing || row.extra ? ` ${row.missing ? "−" + row.missing : ""} ${row.extra ? "+" + row.extra : ""}` : "";
        const text = row.verdict === 1 ? "wrong" + much : verdict;
        const note = this.notes.find(each => each.scene === row.scene && each.variants.includes(row.variant));
        return make("td", {class: verdict}, note ? make("button", {onclick: () => this.open(note, row)}, text) : text);
    }

    /* Show the session of a wrong answer. */
    open(note, row)
    {
        const file = `${row.variant}-${row.scene}.json`.replace(/[^a-z0-9.+-]+/gi, "-");
        this.opened.replaceChildren(
            make("h3", {}, `${row.variant}, ${row.scene}: a wrong answer about ${row.example} point${row.example === 1 ? "" : "s"}`),
            make("p", {}, make("button", {onclick: () => saveText(note.text, file)}, `Save as ${file}`), " and watch it with ", make("code", {}, `octreel play ${file}`)),
            make("pre", {tabindex: 0}, note.text));
        this.opened.scrollIntoView({block: "nearest"});
    }

    draw()
    {
    }
}

function saveText(text, name)
{
    const link = make("a", {href: URL.createObjectURL(new Blob([text])), download: name});
    link.click();
    URL.revokeObjectURL(link.href);
}

/* ---- A chapter -------------------------------------------------------------------------------------------------- */

class Chapter {
    constructor(about)
    {
        this.about = about;
        this.rows = readTable(document, about.name);
        this.other = [];
        this.byVariant = about.charts.some(chart => chart.byVariant);
        this.seriesKey = this.byVariant ? "variant" : "scene";
        this.choiceKey = this.byVariant ? "scene" : "variant";
        this.series = sortByLibrary(unique(this.rows.map(row => row[this.seriesKey])));
        this.hidden = new Set();
        this.matrix = about.charts.some(chart => chart.matrix);
        this.charts = about.charts.map(chart => chart.matrix ? new Matrix(about, chart, this.rows, readBlock("notes", about.name)) : new Chart(about, chart));
        this.lists = this.matrix ? [] : this.makeLists();
        this.element = this.makeElement();
        this.draw();
    }

    /* One list for each part of the names that are not series. */
    makeLists()
    {
        const parts = unique(this.rows.map(row => row[this.choiceKey])).map(name => name.split(" / "));
        return Array.from({length: parts[0]?.length ?? 0}, (_, i) => {
            const names = unique(parts.map(part => part[i]));
            return names.length > 1 ? make("select", {"aria-label": `${this.about.title}: choice ${i + 1}`, onchange: () => this.draw()}, ...names.map(name => make("option", {}, name))) : {value: names[0]};
        });
    }

    makeLegend()
    {
        return make("div", {class: "legend"}, ...this.series.map((name, i) =>
            make("button", {"aria-pressed": "true", onclick: event => this.toggle(name, event.currentTarget)},
                 make("svg", {viewBox: "-7 -7 14 14", width: 14, height: 14, "aria-hidden": "true"}, drawMark(i, false)), name)));
    }

    toggle(name, button)
    {
        if (!this.hidden.delete(name))
            this.hidden.add(name);
        button.setAttribute("aria-pressed", !this.hidden.has(name));
        this.draw();
    }

    makeElement()
    {
        const a = this.about;
        const facts = [["Trades", a.trades], ["Default", a.preset], ["Why", a.defence], ["Proven", a.proven], ["Truth", a.truth]];
        return make("section", {},
            make("h2", {id: a.name}, a.title), make("p", {class: "headline"}, a.headline),
            make("div", {class: "controls"}, ...this.lists.filter(list => list instanceof Element)),
            this.matrix ? null : this.makeLegend(), make("div", {class: "charts"}, ...this.charts.map(chart => chart.element)),
            make("dl", {}, ...facts.flatMap(([name, text]) => [make("dt", {}, name), make("dd", {}, text)]),
                 make("dt", {}, "Bounds"), a.beyond ? make("dd", {class: "broken"}, `${a.beyond} values are beyond their bound`) : make("dd", {class: "holds"}, "every measured value is within its bound")),
            this.makePictures(), this.makeTable());
    }

    makePictures()
    {
        return make("div", {class: "pictures"}, ...readBlock("pictures", this.about.name).map(({caption, png}) =>
            make("figure", {}, make("img", {src: `data:image/png;base64,${png}`, alt: caption, onload: event => { event.target.width = 2 * event.target.naturalWidth; }}), make("figcaption", {}, caption))));
    }

    /* The table is made when it is opened. */
    makeTable()
    {
        const box = make("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": `Figures of ${this.about.title}`});
        const columns = this.about.columns;
        const fill = () => box.childElementCount || box.append(make("table", {},
            make("tr", {}, ...["scene", "variant", ...columns.map(column => column.name)].map(name => make("th", {scope: "col"}, name))),
            ...this.rows.map(row => make("tr", {}, make("td", {}, row.scene), make("td", {}, row.variant), ...columns.map(column => make("td", {}, shorten(row[column.name])))))));
        return make("details", {ontoggle: fill}, make("summary", {}, `All ${this.rows.length} rows`),
                    make("ul", {}, ...columns.map(column => make("li", {}, make("b", {}, column.name), `: ${column.meaning}`))),
                    make("p", {}, make("button", {onclick: () => this.save()}, `Save as ${this.about.name}.csv`)), box);
    }

    save()
    {
        const columns = ["scene", "variant", ...this.about.columns.map(column => column.name)];
        saveText([columns, ...this.rows.map(row => columns.map(column => row[column]))].map(line => `${line.join(",")}\n`).join(""), `${this.about.name}.csv`);
    }

    draw()
    {
        const chosen = this.lists.map(list => list.value).join(" / ");
        const shown = [this.rows, this.other].flatMap((rows, other) => rows
            .filter(row => row[this.choiceKey] === chosen && !this.hidden.has(row[this.seriesKey]))
            .map(row => ({...row, other, series: this.series.indexOf(row[this.seriesKey])}))).filter(row => row.series >= 0);
        for (const chart of this.charts)
            chart.draw(shown);
    }
}

/* ---- The page --------------------------------------------------------------------------------------------------- */

function describe(about)
{
    return `${about.date}, ${about.machine}; ${about.compiler}; ${about.points}; medians of ${about.rounds} rounds of processor time, in turn; ${about.libraries}.`;
}

/* Lay another page's figures over this one's. */
async function overlay(file, chapters, said)
{
    try {
        const other = new DOMParser().parseFromString(await file.text(), "text/html");
        said.textContent = `Hollow marks: ${describe(readAbout(other))}`;
        for (const chapter of chapters) {
            chapter.other = readTable(other, chapter.about.name);
            chapter.draw();
        }
    } catch {
        said.textContent = `${file.name} is not a page of octree-tradeoff.`;
    }
}

/* What each knob buys, with those that never make anything a tenth faster last. */
function makeGains(chapters)
{
    const gains = chapters.flatMap(chapter => chapter.gains.map(gain => ({...gain, chapter}))).sort((a, b) => b.times - a.times);
    if (!gains.length)
        return null;
    return make("section", {}, make("h2", {id: "gains"}, "What each knob of Octreel buys"),
        make("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": "What each knob buys"}, make("table", {class: "gains"},
            make("tr", {}, ...["knob", "times as fast", "where", "remark"].map(name => make("th", {scope: "col"}, name))),
            ...gains.map(gain => make("tr", {}, make("td", {}, make("a", {href: `#${gain.chapter.name}`}, gain.what)), make("td", {}, gain.times.toFixed(2)),
                make("td", {}, gain.where), make("td", {class: gain.times < 1.1 ? "broken" : ""}, gain.times < 1.1 ? "never buys a tenth" : ""))))),
        make("p", {}, "Medians of the scenes, at the setting with the largest gain. What is lost is in the chapter."));
}

/* Only the legend and the first two charts: for the README's picture. */
function showPicture(chapter)
{
    chapter.lists[1].value = "8 nearest";
    chapter.toggle("octreel leaves", make("button"));
    chapter.element.querySelector(".legend").lastChild.remove();
    document.body.replaceChildren(make("h3", {}, "The 8 nearest of 100,000 uniform points; each line is an index from epsilon 0 to 4"), chapter.element.querySelector(".legend"), chapter.element.querySelector(".charts"));
    chapter.charts.slice(2).forEach(chart => chart.element.remove());
    chapter.charts.forEach(chart => chart.said.remove());
}

function build()
{
    const about = readAbout(document);
    const chapters = about.chapters.map(chapter => new Chapter(chapter));
    const said = make("p", {role: "status"});
    const input = make("input", {type: "file", id: "other", accept: ".html", onchange: event => event.target.files[0] && overlay(event.target.files[0], chapters, said)});
    document.body.append(
        make("header", {}, make("h1", {}, "What speed costs in accuracy, and accuracy in speed"),
             make("p", {}, "Octreel and other libraries, and every knob of Octreel that trades the two, compared with a truth that is exact. Lines without marks are proven bounds. Counts are the same on every machine; times are of this one: ", describe(about)),
             about.quick ? make("p", {class: "broken"}, "This is the small version: its times mean little.") : null,
             make("p", {}, make("label", {for: "other"}, "Compare with a page of another machine: "), input), said),
        make("nav", {"aria-label": "Chapters"}, make("ul", {}, ...about.chapters.map(chapter => make("li", {}, make("a", {href: `#${chapter.name}`}, chapter.title))))),
        make("main", {}, makeGains(about.chapters), ...chapters.map(chapter => chapter.element)));
    if (location.hash === "#picture")
        showPicture(chapters[0]);
}

build();
