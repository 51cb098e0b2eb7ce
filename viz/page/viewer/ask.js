/* SPDX-License-Identifier: MIT */
/* ask.js - the form that asks a query at the shown tick. The module provides the query kinds with their names and
 * members. */
"use strict";

/* The label and the initial value of the input of a query member, by the member's name. A member that is not listed has
 * its name as the label, and the initial value of its type. */
const QUERY_INPUTS = {
    k: ["count", "8"],
    radius: ["radius", "100"],
    at: ["position", "0,0,0"],
    box: ["box (two corners)", "-100,-100,-100,100,100,100"],
    ray: ["direction", "1,0,0"],
    thickness: ["thickness", "0"],
    length: ["length (0: no end)", "0"],
    bounds: ["boundary"],
    sweep: ["end", "100,0,0"],
    half: ["half extents", "0,0,0"],
    frustum: ["half-spaces (nx,ny,nz,offset each)", "1,1,1,0"],
};
const INPUT_VALUES = {position: "0,0,0", number: "1", box: "-100,-100,-100,100,100,100"};

class AskForm {
    /* `ask(query)` is called with a query in the form of a session file. `forget()` is called to remove the query. */
    constructor(root, kinds, {ask, forget})
    {
        this.kinds = kinds;
        this.kind = element("select", "", {"aria-label": "Query kind"});
        for (const {name, words} of kinds)
            this.kind.append(new Option(words, name));
        this.inputs = {};
        for (const {name, type, choices} of kinds.flatMap(({members}) => members)) {
            const [label, value] = QUERY_INPUTS[name] ?? [name, INPUT_VALUES[type]];
            this.inputs[name] ??= this.input(label, value, choices);
        }
        const button = element("button", "Run query", {type: "submit"});
        const reset = element("button", "Clear", {type: "button"});
        this.shoot = element("button", "Shoot ray", {type: "button", id: "shoot", title: "Ray through the clicked pixel"});
        this.shoot.hidden = true;
        root.append(this.kind, ...Object.values(this.inputs).map(({label}) => label), button, reset, this.shoot);
        this.kind.addEventListener("change", () => this.showInputs());
        reset.addEventListener("click", forget);
        this.shoot.addEventListener("click", () => {
            this.setRay();
            ask(this.query());
        });
        root.addEventListener("submit", event => {
            event.preventDefault();
            ask(this.query());
        });
        this.showInputs();
    }

    /* Make a text input, or a list of choices if there are any. The first choice is selected initially. */
    input(name, value, choices)
    {
        const input = choices ? element("select") : element("input", "", {type: "text", value});
        input.append(...(choices ?? []).map(choice => new Option(choice)));
        const label = element("label", element("span", name));
        label.append(input);
        return {label, input};
    }

    get members()
    {
        return this.kinds.find(({name}) => name === this.kind.value).members;
    }

    showInputs()
    {
        for (const [member, {label}] of Object.entries(this.inputs))
            label.hidden = !this.members.some(({name}) => name === member);
    }

    /* Fill in the position `place`, a box around this position with a tenth of the world's extent, and a radius. `ray`
     * passes through the clicked pixel. */
    setPlace(place, extent, ray)
    {
        this.ray = ray;
        this.shoot.hidden = false;
        this.inputs.at.input.value = place.map(roundedPlace).join(",");
        this.inputs.box.input.value =
            [-1, 1].flatMap(side => place.map(at => roundedPlace(at + side * extent / 20))).join(",");
        this.inputs.radius.input.value = rounded(extent / 20);
    }

    /* Select the kind "ray", and fill in the ray through the clicked pixel. */
    setRay()
    {
        const {origin, direction, thickness} = this.ray;
        this.kind.value = "ray";
        this.inputs.at.input.value = origin.map(roundedPlace).join(",");
        this.inputs.ray.input.value = direction.map(roundedPlace).join(",");
        this.inputs.thickness.input.value = thickness;
        this.inputs.length.input.value = 0;
        this.showInputs();
    }

    value({name, type})
    {
        const {value} = this.inputs[name].input;
        if (type === "choice")
            return value;
        const numbers = numbersOf(value);
        if (type === "half-spaces")
            return numbers.flatMap((_, i) => (i % 4 === 0 ? [numbers.slice(i, i + 4)] : []));
        if (type === "box")
            return {min: numbers.slice(0, 3), max: numbers.slice(3)};
        return type === "position" ? numbers : numbers[0];
    }

    /* The query in the form of a session file. The name of its first member is determined by the query kind. */
    query()
    {
        const [named, ...others] = this.members;
        return {[this.kind.value]: this.value(named),
                ...Object.fromEntries(others.map(member => [member.name, this.value(member)]))};
    }
}
