/* SPDX-License-Identifier: MIT */
/* view.js - the controls of the view: one row for each member of recording.json. The module lists the possible
 * values. */
"use strict";

const AXES = ["x", "y", "z"];

const DEEPEST = 21; /* OCTREE_MAX_DEPTH */

/* Number("") is 0. The functions below return NaN for a missing number, which the module refuses. */
const numberOf = text => text?.trim() ? Number(text) : NaN;
const numbersOf = text => text.trim() === "" ? [] : text.trim().split(/\s*,\s*|\s+/).map(numberOf);

/* Read a range of depths: "2:5", "2:", ":5" or "3". */
function depthsOf(text)
{
    const [, from, colon, to] = /^(\d*)(:?)(\d*)$/.exec(text.trim()) ?? [];
    if (!from && !to)
        return [NaN, NaN];
    return [Number(from), colon ? Number(to || DEEPEST) : Number(from)];
}

/* The rows of the view. Each row has a member of the view, its label and its control. The control is a choice from the
 * module's list, a switch, a number, or a text. A text has functions that read and write it; an empty text removes the
 * member. */
const VIEW_ROWS = [
    ["camera", "camera", "choice"],
    ["look", "direction (degrees)", "text", {hint: "30,22", read: numbersOf, write: look => look.join(",")}],
    ["center", "center", "text", {hint: "x,y,z", read: numbersOf, write: center => center.join(",")}],
    ["zoom", "zoom", "text", {hint: "1", read: Number, write: String}],
    ["color_by", "color nodes by", "choice"],
    ["color_points", "color points by", "choice"],
    ["shade", "shade", "choice"],
    ["tree", "tree", "choice"],
    ["diagram", "diagram", "choice"],
    ["closeup", "close-up", "switch"],
    ["labels", "labels", "switch"],
    ["leaves", "leaves only", "switch"],
    ["depths", "depths", "text", {hint: "2:5", read: depthsOf, write: ([from, to]) => `${from}:${to}`}],
    ["slice", "slice", "text", {
        hint: "z=100",
        read: text => ({[text.trim()[0]]: numberOf(text.split("=")[1])}),
        write: slice => Object.entries(slice).map(([axis, at]) => `${axis}=${at}`).join(),
    }],
    ["region", "region", "text", {
        hint: "x,y,z,x,y,z",
        read: text => ({min: numbersOf(text).slice(0, 3), max: numbersOf(text).slice(3)}),
        write: ({min, max}) => [...min, ...max].join(","),
    }],
    ["lod", "smallest box (px)", "number"],
    ["budget", "most boxes", "number"],
];

class ViewControls {
    /* `change(members)` is called with the members of the view that the user changed. */
    constructor(root, choices, change)
    {
        this.root = root;
        this.choices = choices;
        this.change = change;
        this.rows = VIEW_ROWS.map(([member, name, kind, text]) => {
            const input = this[kind](member, text);
            const row = element("label", element("span", name));
            row.append(input.element);
            root.append(row);
            return {member, show: input.show};
        });
        this.layers = element("fieldset", element("legend", "layers"));
        this.boxes = choices.layers.map(layer => this.layer(layer));
        root.append(this.layers);
    }

    choice(member)
    {
        const select = element("select");
        for (const name of this.choices[member] ?? [])
            select.append(new Option(name, name));
        select.addEventListener("change", () => {
            /* reset values that belong to the old choice: each camera has its own direction, center and zoom, and each
             * colouring of points its own scale */
            const own = {camera: {look: undefined, center: undefined, zoom: undefined},
                         color_points: {derived: {...this.view.derived, point_scale: undefined}}};
            this.change({[member]: select.value, ...own[member]});
            select.blur();
        });
        return {element: select, show: value => select.value = value ?? this.choices[member][0]};
    }

    switch(member)
    {
        const box = element("input", "", {type: "checkbox"});
        box.addEventListener("change", () => this.change({[member]: box.checked}));
        return {element: box, show: value => box.checked = value ?? false};
    }

    number(member)
    {
        const input = element("input", "", {type: "number", min: 0});
        input.addEventListener("change", () => this.change({[member]: input.valueAsNumber || 0}));
        return {element: input, show: value => input.value = value ?? 0};
    }

    text(member, {hint, read, write})
    {
        const input = element("input", "", {type: "text", placeholder: hint});
        input.addEventListener("change", () => this.change({[member]: input.value.trim() ? read(input.value) : undefined}));
        return {element: input, show: value => input.value = value ? write(value) : ""};
    }

    layer({name, words, color})
    {
        const box = element("input", "", {type: "checkbox", "data-layer": name});
        const label = element("label", box, {title: words});
        const swatch = element("i");
        swatch.style.background = color;
        label.append(swatch, name);
        this.layers.append(label);
        box.addEventListener("change", () => this.change(
            {layers: this.boxes.filter(other => other.checked).map(other => other.dataset.layer)}));
        return box;
    }

    show(view)
    {
        this.view = view;
        for (const {member, show} of this.rows)
            show(view[member]);
        for (const box of this.boxes)
            box.checked = view.layers.includes(box.dataset.layer);
    }
}

/* The command-line options of a view. Each row has a member of the view, the name of its option, and functions that write
 * and read the option's value. A switch has its value in place of the functions. Some names have texts above. */
const textOption = member => {
    const {read, write} = VIEW_ROWS.find(([name]) => name === member)[3];
    return [member, member, write, read];
};
const VIEW_OPTIONS = [
    ...["camera", "color_by", "color_points", "shade", "tree", "diagram"].map(
        member => [member, member.replace("_", "-"), String, String]),
    ["labels", "labels", true],
    ["leaves", "leaves", true],
    ["closeup", "no-closeup", false],
    ["lod", "lod", String, Number],
    ["budget", "budget", String, Number],
    ["layers", "layers", value => value.join(",") || "none", text => text === "none" ? [] : text.split(",")],
    ...["look", "center", "zoom", "depths", "slice", "region"].map(textOption),
];

/* The command-line options that turn the recorded view into `view`. With `all`, members of the recorded view that `view`
 * lacks have the value "none", which only addresses have. */
function optionsOf(view, recorded, all = false)
{
    const isChanged = ([member]) => JSON.stringify(view[member] ?? null) !== JSON.stringify(recorded[member] ?? null);
    return VIEW_OPTIONS.filter(isChanged).map(([member, name, write]) => {
        const value = view[member] ?? null;
        if (typeof write === "boolean")
            return value === write ? `--${name}` : all ? `--${name} none` : "";
        return value !== null ? `--${name} ${write(value)}` : all ? `--${name} none` : "";
    }).filter(option => option).join(" ");
}

/* Apply the options in a text, such as "--zoom 2", to a copy of the recorded view. The module checks the values. */
function viewOf(text, recorded)
{
    const view = {...recorded}, words = text.split(/\s+/).filter(word => word);
    while (words.length > 0) {
        const word = words.shift(), [member, , write, read] = VIEW_OPTIONS.find(([, name]) => word === `--${name}`) ?? [];
        if (!member)
            throw new Error(`"${shownName(word)}" is not an option of the view`);
        if (typeof write !== "boolean" && !/^(?!--)./.test(words[0] ?? ""))
            throw new Error(`${word} needs a value`);
        if (typeof write === "boolean")
            view[member] = (words[0] === "none") !== write;
        else if (words[0] === "none" && member !== "layers")
            delete view[member];
        else
            view[member] = read(words[0]);
        if (typeof write !== "boolean" || words[0] === "none")
            words.shift();
    }
    return view;
}
