/* SPDX-License-Identifier: MIT */
/* sentences.js - a tick in plain words, for the inspector and the list of events.
 *
 * A sentence is a list of parts: strings, and elements such as links. A tick contains ids and addresses but not the
 * positions of the points it names, so a sentence also asks `look`, which knows more if the page plays this tick:
 * look.at(id) is a position, look.node(address) a node as the module describes it; both may be undefined. look.capacity
 * is the capacity of a leaf, and look.player the id of the player, if they are known. */
"use strict";

/* The reasons of a refusal, as the names of octree_status. */
const REFUSALS = {
    __proto__: null,
    full: "its leaf is full and cannot split further",
    outside: "it is outside the world",
    duplicate: "a point with this id already exists",
    not_found: "the tree has no such point",
    not_finite: "a coordinate is not a finite number",
};

/* The kinds of wrong foreign nodes, as the names of octree_wrong_node_kind. */
const WRONG_NODES = {
    __proto__: null,
    outside_parent: "its box leaves the box of its parent",
    unknown_point: "it lists a point that does not exist",
    outside_point: "it lists a point outside its box",
    repeated_point: "it lists a point more than once",
    lost_point: "a point is in no node",
    unknown_node: "a query names it, but it does not exist",
    pruned_point: "a query pruned it, so the answer lacks a point in it",
};

/* The objects "tree" and "player" of a session's header. Only the beginning of the text is searched, because the text may
 * have many megabytes, and octreel writes both objects before the points. Without an argument, the text is that of the
 * last call, or the session of the page. */
function sessionHead(text = sessionHead.text ?? byId("session")?.textContent.trim() ?? "")
{
    if (text === sessionHead.text)
        return sessionHead.found;
    const head = {};
    for (const [, name, value] of text.slice(0, 4096).matchAll(/(?<!\\)"(tree|player)":\s*(\{[^{}]*\})/g))
        try {
            head[name] ??= JSON.parse(value);
        } catch {
            /* not a member of the session */
        }
    sessionHead.text = text;
    return sessionHead.found = {capacity: head.tree?.capacity, player: head.player?.id};
}

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

/* Whether a link can select an element: only a page that plays knows where the element is. */
const canSelect = hasModule();

/* A link that selects an element by its name, as Engine.describe() takes it. */
function elementLink(name, text = name)
{
    return canSelect ? element("a", text, {href: "#", "data-select": name})
                     : element("span", text);
}

const pointLink = (id, text = `point ${id}`) => elementLink(`point ${id}`, text);
const idLink = id => pointLink(id, String(id));
const nodeLink = (path, text = path === "root" ? "the root" : `node ${path}`) => elementLink(`node ${path}`, text);
const foreignLink = id => elementLink(`foreign ${id}`, `foreign node ${id}`);
const tickLink = tick => element("a", `tick ${grouped(tick)}`, {href: "#", "data-go": tick});

/* A position. The tooltip has all digits. */
function placeText(place)
{
    if (!Array.isArray(place))
        return textOf(place ?? null);
    const exact = `(${place.map(textOf).join(", ")})`, read = `(${place.map(readable).map(textOf).join(", ")})`;
    return read === exact ? exact : element("span", read, {title: exact});
}

function numberText(value)
{
    return showPlain([value]);
}

/* Join parts as in a sentence: "a, b and c". After `most` of them comes "and 5 more". */
function enumerated(items, make, most = 8)
{
    const shown = keptEntries(items).slice(0, items.length > most + 1 || leftOut(items) ? most : items.length);
    const rest = listLength(items) - shown.length;
    return shown.flatMap((item, i) => [i === 0 ? "" : i === shown.length - 1 && !rest ? " and " : ", ", make(item)])
                .concat(rest ? ` and ${grouped(rest)} more` : []);
}

const textOfParts = parts => parts.map(part => part.textContent ?? part).join("");

/* A key of the game with its meaning. */
function keyParts(key)
{
    return ["Key ", element("kbd", textOf(key)), KEY_MEANINGS[key] ? ` (${KEY_MEANINGS[key]}): ` : ": "];
}

/* ---- The player -------------------------------------------------------------------------------------------------- */

const isSame = (a, b) => a?.every((number, i) => number === b?.[i]) ?? false;

/* The points that the player collides with, and where they are. */
function hitParts(hits, look)
{
    return enumerated(hits, id => {
        const at = look.at(id), part = element("span", pointLink(id));
        if (at)
            part.append(" at ", placeText(at));
        return part;
    });
}

/* The refusal of the player's step by a full leaf. Every other refusal is about another point. */
function refusalOfStep({events = [], attempt, refusals = []}, look)
{
    const isOwn = ({id, position}) => isSame(position, attempt) && id === (look.player ?? id);
    return events.includes("full") && attempt ? keptEntries(refusals).find(isOwn) : undefined;
}

/* What the player's key did, as sentences with the names of their events. */
function describeStep(tick, look)
{
    const {tick: number, key = null, player = null, attempt, from, events = [], hits = []} = tick, said = [];
    const keyed = key === null ? [] : keyParts(key), isTried = attempt && !isSame(attempt, player);
    const at = player === null ? "" : placeText(player);
    if (events.includes("moved"))
        said.push(["moved", ...keyed, "the player moved", ...(from ? [" from ", placeText(from)] : []), " to ", at]);
    if (events.includes("refused"))
        said.push(["refused", ...keyed, "step refused: it would leave the world; the player stays at ", at]);
    if (hits.length > 0 && isTried)
        said.push(["collided", ...keyed, "collided with ", ...hitParts(hits, look), "; step to ", placeText(attempt),
                   " taken back"]);
    else if (hits.length > 0)
        said.push(["collided", "Collided with ", ...hitParts(hits, look),
                   ...(at ? ["; the player at ", at, " made no step"] : [])]);
    if (refusalOfStep(tick, look))
        said.push(["full", ...keyed, "step to ", placeText(attempt), ` taken back: ${REFUSALS.full}`]);
    if (said.length === 0 && player !== null)
        said.push(["", ...keyed, keyed.length ? "the" : "The", ` player ${number === 0 ? "starts" : "is"} at `, at]);
    else if (said.length === 0 && keyed.length && key !== ".")
        said.push(["", ...keyed, "there is no player"]);
    return said;
}

/* ---- The tree ---------------------------------------------------------------------------------------------------- */

/* Nodes that split or merged: a list of addresses, or the number of them if there were too many to list. */
function describeChanges(event, nodes, look, describeOne)
{
    const count = nodes.count ?? listLength(nodes), verb = event === "split" ? "split" : "merged";
    if (!count)
        return [];
    if (!Array.isArray(nodes))
        return [[event, `${counted(count, "node")} ${verb}`]];
    if (count === 1)
        return [[event, "Node ", nodeLink(nodes[0], nodes[0]), ` ${verb}`, ...describeOne(look.node(nodes[0]))]];
    const limit = look.capacity ? `; capacity ${grouped(look.capacity)}` : "";
    const one = path => {
        const made = element("span", nodeLink(path, path)), points = look.node(path)?.node.points;
        made.append(points === undefined ? "" : ` (${counted(points, "point")})`);
        return made;
    };
    return [[event, `${grouped(count)} nodes ${verb}: `, ...enumerated(nodes, one, 4), limit]];
}

function describeSplit({capacity})
{
    const limit = capacity ? grouped(capacity) : "";
    return found => found?.children
        ? [` into ${counted(found.children.length, "node")}: ${counted(found.node.points, "point")}`,
           limit && ` for capacity ${limit}`]
        : [limit && `: more points than its capacity, ${limit}`];
}

function describeMerge({capacity})
{
    return found => [" into one leaf" + (found?.node.leaf ? ` of ${counted(found.node.points, "point")}` : "") +
                     (capacity ? `; capacity ${grouped(capacity)}` : "")];
}

/* Sentences about the points that the tree refused. A tick may list many; only the first ones get a sentence. */
function describeRefusals(tick, look)
{
    const refusals = tick.refusals ?? [], own = refusalOfStep(tick, look);
    const others = keptEntries(refusals).filter(refusal => refusal !== own), told = others.slice(0, 8);
    const rest = listLength(refusals) - (own ? 1 : 0) - told.length;
    return told.map(({id, why, position}) => [why === "full" ? "full" : "", "Point ", idLink(id), " at ",
                                              placeText(position), " refused: ", REFUSALS[why] ?? textOf(why ?? null)])
        .concat(rest > 0 ? [["", `${counted(rest, "more point")} refused`]] : []);
}

/* ---- Queries ----------------------------------------------------------------------------------------------------- */

/* The name of a query with its parameters, such as "4 nearest to (1, 2, 3)". */
const QUERY_TITLES = {
    __proto__: null,
    nearest: ({target}) => ["Nearest to ", placeText(target)],
    knearest: ({target, k}) => [`${textOf(k)} nearest to `, placeText(target)],
    radius: ({center, radius}) => ["Within ", numberText(radius), " of ", placeText(center)],
    ray: ({origin, direction, k, thickness, length}) =>
        [k === 1 ? "First hit of the ray from " : `First ${textOf(k)} hits of the ray from `, placeText(origin),
         " in direction ", placeText(direction), ...(thickness ? [", thickness ", numberText(thickness)] : []),
         ...(length ? [", length ", numberText(length)] : [])],
    sweep: ({from, to, half, k}) =>
        [k === 1 ? "First hit of the box moving from " : `First ${textOf(k)} hits of the box moving from `,
         placeText(from), " to ", placeText(to), ...(half ? [", half extents ", placeText(half)] : [])],
    frustum: ({half_spaces}) => [`In ${counted(listLength(half_spaces ?? []), "half-space")}`],
    range: ({min, max}) => ["In the box ", placeText(min), " to ", placeText(max)],
};

const queryTitle = (kind, query) => QUERY_TITLES[kind]?.(query) ?? [kind.replaceAll("_", " ")];

/* How an answer is wrong, as the names of octree_wrong_kind. */
const WRONG_ANSWERS = {
    __proto__: null,
    unknown: ({wrong_id}) => ["it names point ", textOf(wrong_id ?? null), ", which does not exist"],
    duplicate: ({wrong_id}) => ["it names ", pointLink(wrong_id), " twice"],
    skipped: ({wrong_id}) => ["it names ", pointLink(wrong_id), ", which the query skips"],
    count: ({answer = [], expected}) =>
        [`it has ${counted(listLength(answer), "neighbour")} instead of ${textOf(expected ?? null)}`],
    farther: ({rank}) => [`neighbour ${textOf(rank)} is too far`],
};

/* What is wrong with a judged answer; null if it is right. */
function describeWrong(judged)
{
    const {wrong = "none", missing = [], extra = []} = judged ?? {}, said = [];
    if (wrong === "none")
        return null;
    if (WRONG_ANSWERS[wrong])
        said.push(WRONG_ANSWERS[wrong](judged));
    for (const [word, ids] of [["missing", missing], ["extra", extra]])
        if (ids.length > 0)
            said.push([`${word} `, ...enumerated(ids, id => pointLink(id))]);
    return said.length === 0 ? [wrong] : said.flatMap((parts, i) => i === 0 ? parts : ["; ", ...parts]);
}

const queriesOf = tick => keptEntries(tick.answers ?? []).flatMap(answer => Object.entries(answer));

function describeWrongAnswers(tick)
{
    const said = [];
    for (const [kind, query] of queriesOf(tick)) {
        const wrong = describeWrong(query?.judged);
        if (wrong)
            said.push(["wrong", "Wrong answer to \u201c", ...queryTitle(kind, query), "\u201d: ", ...wrong]);
    }
    return said;
}

function describeWrongNodes({foreign_nodes: foreign})
{
    const {count = 0, first = []} = foreign?.wrong ?? {};
    const said = keptEntries(first).map(({wrong, node, point, answer}) => [
        "wrong", node === undefined ? "Foreign nodes" : foreignLink(node), ": ", WRONG_NODES[wrong] ?? textOf(wrong),
        ...(point === undefined ? [] : [" (", pointLink(point), ")"]),
        ...(answer === undefined ? [] : [`, query ${answer + 1}`])]);
    const rest = count - said.length;
    return rest > 0 ? [...said, ["wrong", `${counted(rest, "more wrong foreign node")}`]] : said;
}

function pairLink([a, b])
{
    const made = element("span", pointLink(a));
    made.append(" and ", pointLink(b));
    return made;
}

/* Bodies whose boxes overlap: a list of pairs of ids, or the number of pairs if there were too many to list. */
function describePairs({pairs = []})
{
    const count = pairs.count ?? listLength(pairs);
    if (!count)
        return [];
    if (!Array.isArray(pairs))
        return [["overlapped", `${counted(count, "pair")} of bodies overlap`]];
    if (count === 1)
        return [["overlapped", "The boxes of ", pairLink(pairs[0]), " overlap"]];
    return [["overlapped", `${grouped(count)} pairs of boxes overlap: `, ...enumerated(pairs, pairLink, 4)]];
}

/* The pairs of bodies that a foreign index found, and what is wrong with them. */
function describeForeignPairs({foreign_pairs: found})
{
    if (!found)
        return [];
    const {wrong = "none", wrong_pair: [a, b] = [], given = [], missing = [], extra = []} = found, said = [];
    const countOf = pairs => pairs.count ?? listLength(pairs);
    if (wrong === "none")
        return [["", `The foreign index found all pairs of bodies that overlap: ${grouped(countOf(given))}`]];
    if (wrong === "unknown")
        said.push(`; it names ${textOf(a)}, which is no body`);
    if (wrong === "duplicate")
        said.push("; it names ", pairLink([a, b]), " twice");
    for (const [word, pairs] of [["missing", missing], ["extra", extra]])
        if (countOf(pairs))
            said.push(`; ${grouped(countOf(pairs))} ${word}`,
                      ...(Array.isArray(pairs) ? [": ", ...enumerated(pairs, pairLink, 4)] : []));
    return [["wrong", `Wrong foreign pairs, ${grouped(countOf(given))} given`, ...said]];
}

/* ---- A tick ------------------------------------------------------------------------------------------------------ */

/* Everything that happened at a tick, wrong answers first: a list of sentences. The first item of a sentence is the
 * name of its event, or "". */
function describeTick(tick, more)
{
    const near = queriesOf(tick).flatMap(([, query]) => keptEntries(query.neighbors ?? [query]));
    const known = new Map(near.map(({id, position}) => [id, position]));
    const look = {...more, at: id => more.at(id) ?? known.get(id)};
    return [
        ...describeWrongAnswers(tick),
        ...describeForeignPairs(tick),
        ...describeWrongNodes(tick),
        ...(tick.gap === undefined ? [] : [["", `Gap, nothing was played: ${textOf(tick.gap)}`]]),
        ...describeStep(tick, look),
        ...describeRefusals(tick, look),
        ...describePairs(tick),
        ...describeChanges("split", tick.splits ?? [], look, describeSplit(look)),
        ...describeChanges("merged", tick.merges ?? [], look, describeMerge(look)),
        ...(tick.events ?? []).filter(event => !EVENTS.some(([name]) => name === event))
                              .map(event => ["", `Event: ${textOf(event)}`]),
    ];
}
