/* SPDX-License-Identifier: MIT */
/* ask.js - questions to the tick that is shown, at a place: the kinds of queries as the program names them, and what
 * each of them reads. */
"use strict";

/* The label and the first value of an input: by the member's name, else by its type. */
const QUERY_INPUTS = {
    k: ["how many", "8"],
    radius: ["within", "100"],
    at: ["of the place", "0,0,0"],
    box: ["box (two corners)", "-100,-100,-100,100,100,100"],
};
const INPUT_VALUES = {position: "0,0,0", number: "1", box: "-100,-100,-100,100,100,100"};

class AskForm {
    /* `ask(query)` is called with a query as a session file has it; `forget()` when there is to be none. */
    constructor(root, kinds, {ask, forget})
    {
        this.kinds = kinds;
        this.kind = element("select", "", {"aria-label": "What is asked"});
        for (const {name, words} of kinds)
            this.kind.append(new Option(words, name));
        this.inputs = {};
        for (const {name, type} of kinds.flatMap(({members}) => members))
            this.inputs[name] ??= this.input(...(QUERY_INPUTS[name] ?? [name, INPUT_VALUES[type]]));
        const button = element("button", "Ask", {type: "submit"});
        const reset = element("button", "Ask nothing", {type: "button"});
        root.append(this.kind, ...Object.values(this.inputs).map(({label}) => label), button, reset);
        this.kind.addEventListener("change", () => this.showInputs());
        reset.addEventListener("click", forget);
        root.addEventListener("submit", event => {
            event.preventDefault();
            ask(this.query());
        });
        this.showInputs();
    }

    input(name, value)
    {
        const input = element("input", "", {type: "text", value});
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

    /* The place that is asked about, and a box of a tenth of the world around it. */
    setPlace(place, extent)
    {
        this.inputs.at.input.value = place.map(roundedPlace).join(",");
        this.inputs.box.input.value =
            [-1, 1].flatMap(side => place.map(at => roundedPlace(at + side * extent / 20))).join(",");
        this.inputs.radius.input.value = rounded(extent / 20);
    }

    value({name, type})
    {
        const numbers = numbersOf(this.inputs[name].input.value);
        if (type === "box")
            return {min: numbers.slice(0, 3), max: numbers.slice(3)};
        return type === "position" ? numbers : numbers[0];
    }

    /* The member that bears the kind's name comes first. */
    query()
    {
        const [named, ...others] = this.members;
        return {[this.kind.value]: this.value(named),
                ...Object.fromEntries(others.map(member => [member.name, this.value(member)]))};
    }
}
