/* SPDX-License-Identifier: MIT */
/* inspector.js - the facts of a tick and of the selected element, in sentences and small tables. A link selects an
 * element: it is marked in the picture and described above the tick. */
"use strict";

/* The members of a tick, and of the objects in it, that are shown in words. Every other member is shown as a row with
 * its name, so that a new member needs no change here. */
const TOLD_MEMBERS = ["tick", "key", "player", "events", "from", "attempt", "hits", "hit_cost", "answers", "visits",
                      "foreign_nodes", "foreign_pairs", "refusals", "splits", "merges", "tree", "frame", "scene", "gap"];
const COST_MEMBERS = ["nodes", "leaves", "points", "pruned", "taken"];
const ANSWER_MEMBERS = ["ids", "neighbors", "id", "position", "distance", "t", "cost", "judged", "bounds", "skip",
                        "epsilon"];
const QUERY_PARAMETERS = {
    __proto__: null,
    nearest: ["target"],
    knearest: ["target", "k"],
    radius: ["center", "radius"],
    range: ["min", "max"],
    ray: ["origin", "direction", "k", "thickness", "length"],
    frustum: [],
    sweep: ["from", "to", "half", "k"],
};
const FOREIGN_MEMBERS = ["count", "leaves", "depth", "digest", "visited", "pruned", "hit"];
const JUDGED_MEMBERS = ["answer", "mode", "wrong", "wrong_id", "expected", "missing", "extra", "rank", "ratio"];

const SHOW_DELAY = 250; /* ms */
const FEW_ROWS = 8; /* the number of rows of a table that are shown before "more" */

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

function paragraph(parts, attributes)
{
    const made = element("p", "", attributes);
    made.append(...parts);
    return made;
}

function section(title, ...content)
{
    const made = element("section", "", {class: "told"});
    made.append(paragraph(title, {class: "title"}), ...content);
    return made;
}

/* A sentence of describeTick(), with the sign of its event. */
function sentenceOf([event, ...parts], name = "p")
{
    const sign = EVENTS.find(([known]) => known === event)?.[1];
    const made = element(name, "", {class: "happened", "data-event": event});
    if (sign)
        made.append(element("span", sign, {class: "sign", "aria-hidden": "true"}));
    made.append(...parts);
    return made;
}

/* The members of an object that are not told in words. */
function otherMembers(object, told, path = "")
{
    const rows = Object.entries(object).filter(([name]) => !told.includes(name))
                                       .map(([name, value]) => showFact(name, value, path + name));
    const list = element("dl");
    list.append(...rows);
    return rows.length ? [list] : [];
}

function tableRow(cells, name = "td")
{
    const row = element("tr");
    for (const cell of cells) {
        row.append(element(name));
        row.lastChild.append(...[cell].flat());
    }
    return row;
}

/* A button that is replaced by what `make` returns. */
function moreButton(count, make)
{
    const more = element("button", `${grouped(count)} more`, {type: "button", class: "link"});
    more.addEventListener("click", () => more.replaceWith(...make()));
    return count > 0 ? [more] : [];
}

/* A table that makes its rows after the first few only when the user asks for them. */
function table(heads, items, makeRow)
{
    const kept = keptEntries(items), few = kept.length > FEW_ROWS + 1 ? FEW_ROWS : kept.length;
    const made = element("table", heads.length ? tableRow(heads, "th") : "");
    const rows = (from, to) => kept.slice(from, to).map(item => tableRow(makeRow(item)));
    made.append(...rows(0, few));
    return [made, ...moreButton(listLength(items) - few, () => {
        made.append(...rows(few));
        return showMore(items);
    })];
}

/* Counts as bars on one scale. */
function bars(rows)
{
    const made = element("table", "", {class: "bars"}), most = Math.max(...rows.map(([, count]) => count), 1);
    for (const [name, count] of rows) {
        const bar = element("i");
        bar.style.width = `${100 * count / most}%`;
        made.append(tableRow([name, bar, grouped(count)]));
    }
    return made;
}

const leafText = count => `${grouped(count)} ${count === 1 ? "leaf" : "leaves"}`;

/* The work of a search, such as "58 nodes visited (42 leaves), 168 points compared, 48 nodes pruned". */
function costText({nodes = 0, leaves = 0, points = 0, pruned = 0, taken = 0})
{
    return `${counted(nodes, "node")} visited (${leafText(leaves)}), ` +
        `${counted(points, "point")} compared, ${counted(pruned, "node")} pruned` +
        (taken ? `, ${counted(taken, "node")} taken whole` : "");
}

const distanceOf = (a, b) => Math.hypot(...a.map((at, i) => at - b[i]));

/* ---- Queries ----------------------------------------------------------------------------------------------------- */

/* The found points. The answer itself holds the positions and distances of neighbours, and the t of a ray's hits. The
 * page knows the positions of other points only if it plays the session. */
function showHits({neighbors, id, position, distance, ids, target, center, origin, from: start}, look)
{
    const points = neighbors ?? ids ?? (id === undefined || id === null ? [] : [{id, position, distance}]);
    const from = center ?? target ?? origin ?? start, rows = keptEntries(points).map(point => {
        const hit = typeof point === "object" ? point : {id: point, position: look.at(point)};
        const far = from && hit.position ? distanceOf(hit.position, from) : undefined;
        return {...hit, distance: hit.t ?? hit.distance ?? far};
    });
    if (rows.length === 0)
        return [];
    if (!rows[0].position)
        return [paragraph(["Points ", ...enumerated(points, idLink, 100)])];
    const more = leftOut(points) ? [{more: leftOut(points)}] : [];
    const heads = ["point", ...(from ? [origin ?? start ? "t" : "distance"] : []), "position"];
    return table(heads, [...rows, ...more], hit =>
        [idLink(hit.id), ...(from ? [numberText(hit.distance)] : []), placeText(hit.position)]);
}

/* The answer of a foreign index, and whether it is right. */
function showJudged(judged, path)
{
    const {answer = [], mode, expected, ratio} = judged, wrong = describeWrong(judged);
    const count = `${counted(listLength(answer), "point")} of ${textOf(expected ?? null)} expected`;
    const parts = [`${wrong ? "Wrong" : "Right"} foreign answer, ${count}: `,
                   ...(answer.length ? enumerated(answer, idLink) : [ABSENT])];
    if (ratio !== undefined && ratio !== 1)
        parts.push("; largest ratio to the exact answer ", numberText(ratio));
    if (mode !== undefined)
        parts.push(`; promised for ${textOf(mode)}`);
    return [paragraph(parts, {class: wrong ? "wrong" : "right"}),
            ...otherMembers(judged, JUDGED_MEMBERS, `${path}.judged.`)];
}

function showQuery([kind, query], look, path)
{
    const {ids, neighbors, id, cost, judged, bounds, skip, epsilon} = query;
    const count = listLength(ids ?? neighbors ?? (id === undefined || id === null ? [] : [id]));
    const parts = [`${counted(count, "point")} found`, ...(cost ? [`; ${costText(cost)}`] : [])];
    if (bounds !== undefined)
        parts.push(`; boundary: ${textOf(bounds)}`);
    if (skip !== undefined)
        parts.push(`; ${skip === "coincident" ? "points at the position itself" : `point ${textOf(skip)}`} skipped`);
    if (epsilon !== undefined)
        parts.push("; permitted error ", numberText(epsilon));
    const number = Number(path.split(".")[1]) + 1;
    return section([elementLink(`query ${number}`, `Query ${number}`), ": ", ...queryTitle(kind, query)],
                   ...(judged ? showJudged(judged, path) : []), paragraph(parts), ...showHits(query, look),
                   ...otherMembers(query, [...ANSWER_MEMBERS, ...QUERY_PARAMETERS[kind] ?? []], `${path}.`),
                   ...(cost ? otherMembers(cost, COST_MEMBERS, `${path}.cost.`) : []));
}

/* The queries, wrong answers first. */
function showQueries(answers, look)
{
    const isWrong = ([, query]) => describeWrong(query?.judged) !== null;
    return keptEntries(answers).flatMap((answer, i) => Object.entries(answer).map(entry => [entry, i]))
        .sort(([a], [b]) => isWrong(b) - isWrong(a))
        .map(([entry, i]) => showQuery(entry, look, `answers.${i}.${entry[0]}`))
        .concat(showMore(answers));
}

/* ---- The trees --------------------------------------------------------------------------------------------------- */

/* The nodes that the queries of the tick visited, as bars beside all nodes. */
function visitBars({visited = 0, taken = 0, pruned = 0, hit = 0}, nodes)
{
    const rows = [["visited", visited], ["pruned", pruned], ["taken whole", taken], ["with hits", hit]];
    return visited || taken || pruned ? [bars([...rows.filter(([, count]) => count), ["all nodes", nodes]])] : [];
}

function showTree({tree, visits = {}, hit_cost: cost})
{
    if (!tree)
        return Object.keys(visits).length ? otherMembers({visits}, []) : [];
    const {points = 0, nodes = 0, leaves = 0, depth = 0} = tree;
    const tested = cost?.nodes ? [paragraph([`Collision test: ${costText(cost)}`])] : [];
    return [section(["Tree"],
        paragraph([`${counted(points, "point")} in ${leafText(leaves)}; ${counted(nodes, "node")}, deepest at depth ` +
                   textOf(depth)]),
        ...tested, ...visitBars(visits, nodes),
        ...otherMembers(tree, ["points", "nodes", "leaves", "depth", "digest"], "tree."),
        ...otherMembers(visits, ["visited", "taken", "pruned", "hit"], "visits."),
        ...(cost ? otherMembers(cost, COST_MEMBERS, "hit_cost.") : []))];
}

function showForeign(foreign)
{
    if (!foreign)
        return [];
    const {count = 0, leaves = 0, depth = 0, wrong} = foreign, members = [...FOREIGN_MEMBERS, "wrong"];
    return [section(["Foreign nodes"],
        paragraph([`${counted(count, "node")}, ${leafText(leaves)}, deepest at depth ${textOf(depth)}; ` +
                   (wrong?.count ? `${grouped(wrong.count)} wrong` : "none is wrong")]),
        ...visitBars(foreign, count),
        ...otherMembers(foreign, members, "foreign_nodes."),
        ...otherMembers(wrong ?? {}, ["count", "first", ...Object.keys(WRONG_NODES)], "foreign_nodes.wrong."))];
}

/* The file of the frame, and the digests that identify the scene and the tree. */
function showOrigin({frame, scene, tree})
{
    const parts = [];
    if (frame !== undefined)
        parts.push("frame ", element("a", textOf(frame), {href: `./${frame}`, target: "_blank"}), " ");
    if (scene !== undefined)
        parts.push(`scene ${textOf(scene)} `);
    if (tree?.digest !== undefined)
        parts.push(`tree ${textOf(tree.digest)}`);
    return parts.length ? [paragraph(parts, {class: "origin"})] : [];
}

function tellTick(tick, look)
{
    return [...describeTick(tick, look).map(said => sentenceOf(said)), ...showQueries(tick.answers ?? [], look),
            ...showForeign(tick.foreign_nodes), ...showTree(tick), ...otherMembers(tick, TOLD_MEMBERS),
            ...showOrigin(tick)];
}

/* ---- Elements ---------------------------------------------------------------------------------------------------- */

/* The name of the element that a pick or Engine.describe() describes, in the form that select() takes. */
function elementName({point, node, foreign_node: foreign, query})
{
    return point ? `point ${point.id}` : node ? `node ${node.path}` : foreign ? `foreign ${foreign.id}`
        : query ? `query ${query}` : "";
}

function row(term, parts)
{
    const made = element("div", element("dt", term), {class: "fact"});
    made.append(element("dd"));
    made.lastChild.append(...parts);
    return made;
}

function boxTable({min, max})
{
    return table(["axis", "from", "to", "size"], [0, 1, 2],
                 i => ["xyz"[i], numberText(min[i]), numberText(max[i]), numberText(max[i] - min[i])]);
}

const parentOf = path => path === "root" ? null : path.includes("/") ? path.replace(/\/[^/]*$/, "") : "root";

/* Why a node is as it is: its change at this tick, and what made its cell. */
function nodeReasons({path, leaf, points, capacity, split, arrived = [], left = [], made_by: made}, look)
{
    const said = [], limit = capacity ?? look.capacity;
    if (split)
        said.push([`It split at this tick: ${counted(points, "point")} for capacity ${grouped(limit)}`]);
    else if (leaf === false && limit)
        said.push([`It is split: ${counted(points, "point")} are more than the capacity of a leaf, ${grouped(limit)}`]);
    for (const [ids, verb] of [[arrived, "arrived"], [left, "left"]])
        if (ids.length)
            said.push([ids.length === 1 ? "Point " : "Points ", ...enumerated(ids, idLink), ` ${verb} at this tick`]);
    if (made)
        said.push([...(made.path === path ? ["It merged"] : ["Its cell was made when ", nodeLink(made.path), " split"]),
                   " at ", tickLink(made.tick), `, with ${counted(made.points, "point")}`]);
    else if (capacity !== undefined)
        said.push(["Its cell exists since tick 0"]);
    return said.map(parts => paragraph(parts));
}

const NODE_MEMBERS = ["path", "depth", "leaf", "points", "box", "capacity", "split", "arrived", "left", "made_by"];

function tellNode({node, children = [], holds = []}, look)
{
    const {path, depth, leaf, points = 0, box} = node, parent = parentOf(path), list = element("dl");
    const capacity = node.capacity ?? look.capacity, told = [];
    if (leaf === undefined)
        told.push(paragraph(["An empty cell: no node is here"]));
    else if (leaf)
        told.push(paragraph([`Leaf at depth ${depth}: ${counted(points, "point")}`,
                             capacity ? ` of at most ${grouped(capacity)}` : ""]),
                  ...(capacity ? [bars([["points", points], ["capacity", capacity]])] : []));
    else
        told.push(paragraph([`Inner node at depth ${depth}: ${counted(points, "point")} in and below it`]));
    if (parent !== null)
        list.append(row("parent", [nodeLink(parent, parent)]));
    if (children.length)
        list.append(row("children", enumerated(children, child => nodeLink(child, child))));
    if (holds.length) {
        const more = points - holds.length, ids = [...holds].sort((a, b) => a - b);
        list.append(row("points", enumerated(more > 0 ? [...ids, {more}] : ids, idLink)));
    }
    return [...told, ...nodeReasons(node, look), list, ...boxTable(box), ...otherMembers(node, NODE_MEMBERS)];
}

function tellForeign({id, parent, kind, depth, leaf, points = 0, box, wrong = [], ...others})
{
    const list = element("dl");
    if (parent !== undefined)
        list.append(row("parent", [foreignLink(parent)]));
    return [...wrong.map(name => paragraph([`Wrong: ${WRONG_NODES[name] ?? name}`], {class: "wrong"})),
            paragraph([`${leaf ? "Leaf" : "Inner node"} at depth ${depth}`, kind ? ` of kind \u201c${kind}\u201d` : "",
                       `: ${counted(points, "point")} listed`]),
            list, ...boxTable(box), ...otherMembers(others, [])];
}

function tellPoint({point, leaf, color, intensity, class: kind}, player)
{
    const list = element("dl", row("position", [placeText(point.position)]));
    const swatch = element("i", "", {class: "swatch"});
    if (player)
        list.append(row("distance", [numberText(distanceOf(point.position, player)), " from the player"]));
    if (leaf)
        list.append(row("leaf", [nodeLink(leaf, leaf)]));
    swatch.style.background = color;
    for (const [name, value, parts] of [["colour", color, [swatch, color]], ["intensity", intensity], ["class", kind]])
        if (value !== undefined)
            list.append(row(name, parts ?? [numberText(value)]));
    return [list, ...otherMembers(point, ["id", "position"])];
}

/* ---- The inspector ----------------------------------------------------------------------------------------------- */

class Inspector {
    constructor(viewer)
    {
        this.viewer = viewer;
        this.root = byId("facts-of-tick");
        this.picked = byId("picked");
        this.card = element("div");
        this.others = element("div");
        this.picked.append(this.card, this.others);
        this.raw = element("details", element("summary", "Raw JSON"), {class: "raw"});
        this.raw.append(element("pre", "", {tabindex: "0", "aria-label": "Raw JSON"}));
        this.raw.addEventListener("toggle", () => this.showRaw());
        const opened = new MutationObserver(() => isOpen("sheet") && this.showNow());
        opened.observe(byId("sheet"), {attributeFilter: ["hidden"]});
        document.addEventListener("click", event => {
            const link = event.target.closest("[data-select], [data-go]");
            if (link)
                event.preventDefault();
            if (link?.dataset.select)
                this.select(link.dataset.select);
            else if (link)
                this.viewer.step(Number(link.dataset.go) - this.viewer.tick);
        });
    }

    /* The engine if it plays the shown tick, or undefined. */
    get engine()
    {
        const {interaction} = this.viewer, engine = interaction?.isLive ? interaction.player.engine : undefined;
        return engine?.tick === this.tick?.tick ? engine : undefined;
    }

    /* What is known about the tick in addition to its line of ticks.jsonl (see sentences.js). */
    get look()
    {
        const {engine} = this;
        return {...sessionHead(this.viewer.interaction?.session),
                at: id => engine?.point(id), node: path => engine?.describe(`node ${path}`)};
    }

    /* Show the facts of a tick. If the sheet is open, they are shown at once, otherwise only when the tick stays for
     * SHOW_DELAY, because making the elements takes up to 2 ms, which playing needs. */
    show(tick)
    {
        this.tick = tick;
        clearTimeout(this.waiting);
        if (isOpen("sheet"))
            this.showNow();
        else
            this.waiting = setTimeout(() => this.showNow(), SHOW_DELAY);
    }

    showNow()
    {
        const {tick} = this;
        this.wasPlayed = this.engine !== undefined;
        const title = element("h2", "Tick ");
        title.append(element("span", textOf(tick.tick ?? null), {"data-fact": "tick"}));
        this.root.replaceChildren(title, ...this.tell(tick), this.raw);
        this.showRaw();
    }

    /* The tick in sentences. If no sentences can be made of the tick's line, because another program wrote it, its
     * members are shown as rows. */
    tell(tick)
    {
        try {
            return tellTick(tick, this.look);
        } catch {
            return otherMembers(tick, ["tick"]);
        }
    }

    showRaw()
    {
        if (this.raw.open)
            this.raw.lastChild.textContent = JSON.stringify(this.tick, null, 1);
    }

    /* Called after the picture of a tick was drawn: the page now knows positions and nodes. */
    follow()
    {
        if (!this.wasPlayed && this.engine)
            this.show(this.tick);
        if (this.name && this.engine)
            this.showCard(this.describe(this.name));
    }

    /* What is known of an element of the shown tick, by its name. Undefined if the tick has no such element. */
    describe(name)
    {
        const [word, id] = name.split(" ");
        if (word !== "query")
            return this.viewer.interaction.player.engine.describe(name);
        return this.tick.answers?.[id - 1] && {query: Number(id), answer: this.tick.answers[id - 1]};
    }

    /* Select an element by its name: mark it in the picture and describe it. */
    async select(name)
    {
        const {interaction} = this.viewer;
        if (!await interaction.start() || !interaction.isLive)
            return;
        const {live} = interaction, found = this.describe(name);
        live.subject = found;
        this.name = name;
        this.others.replaceChildren();
        this.showCard(found);
        setOpen("sheet", true);
        live.mark();
        this.viewer.address.writeSoon();
    }

    showCard(found)
    {
        const {look} = this, [word, id] = this.name.split(" ");
        const kinds = {node: found?.node?.leaf ? "Leaf" : "Node", point: "Point", foreign: "Foreign node", query: "Query"};
        if (found?.answer) {
            const [entry] = Object.entries(found.answer);
            this.card.replaceChildren(showQuery(entry, look, `answers.${id - 1}.${entry[0]}`));
            this.picked.hidden = false;
            return;
        }
        const told = !found ? [paragraph(["This tick has no such element"])]
            : found.point ? tellPoint(found, this.tick.player)
            : found.node ? tellNode(found, look) : tellForeign(found.foreign_node);
        this.card.replaceChildren(element("h2", `${kinds[word]} ${id}`), ...told);
        this.picked.hidden = false;
    }

    /* Show the elements at a pixel. `subject` is the marked one, which is described first. */
    showPick({pixel, color, elements}, subject)
    {
        this.name = subject ? elementName(subject) : "";
        this.card.replaceChildren();
        if (this.name && this.engine)
            this.showCard(this.describe(this.name) ?? subject);
        const title = pixel ? `At pixel (${pixel.join(", ")}), ${color}` : "Nothing is drawn here";
        const list = table([], elements, found => [this.pickedParts(found)]);
        this.others.replaceChildren(paragraph([title], {class: "title"}), ...(elements.length ? list : []));
        this.picked.hidden = false;
    }

    pickedParts(found)
    {
        const {text, closeup} = found, name = elementName(found), where = closeup ? " (in the close-up)" : "";
        if (name && text.startsWith(name))
            return [elementLink(name), text.slice(name.length) + where];
        return [text + where, ...(name ? [" \u2013 ", elementLink(name)] : [])];
    }
}
