/* SPDX-License-Identifier: MIT */
/* address.js - the page's address holds what the page shows, so that a link opens exactly this:
 *   #t=41&filter=collided,full&view=--camera+top+--zoom+2&keys=36:wwd&ask={"nearest":[0,0,0]}&select=point+7
 * `view` has the options of the command line that turn the recorded view into the shown one; the value "none" removes a
 * member of the view. `keys` are those that the user pressed, after the tick before the colon. `ask` is the user's query.
 * pixels=recorded shows recorded pixels. A wrong part of an address is ignored, with a sentence. */
"use strict";

/* Milliseconds between two changes of the page's address: browsers refuse an address that changes with each frame. */
const ADDRESS_DELAY = 200;

/* The parts of an address that need the module, in the order in which they are applied. */
const PARTS_OF_MODULE = ["view", "keys", "ask", "select"];

/* Encode a text as a value in an address. Characters that are readable and allowed in an address stay as they are. */
const encoded = text => encodeURIComponent(text).replace(/%(20|2C|3A|2F|3D)/g, code => code === "%20" ? "+" : decodeURIComponent(code));

function readQuery(text)
{
    try {
        return JSON.parse(text);
    } catch {
        throw new Error(`"${shownName(text)}" is not a query`);
    }
}

class Address {
    constructor(viewer)
    {
        this.viewer = viewer;
        this.pending = {}; /* the parts that wait for the module, by name */
        this.faults = [];  /* what is wrong with the address, as sentences */
        addEventListener("hashchange", () => this.read());
        byId("copy-link").addEventListener("click", () => this.copy());
    }

    get interaction()
    {
        return this.viewer.interaction;
    }

    /* ---- Reading -------------------------------------------------------------------------------------------------- */

    /* Show what the address holds. */
    read()
    {
        const parts = new URLSearchParams(location.hash.slice(1)), tick = parts.get("t") ?? "0", faults = [];
        const names = (parts.get("filter") ?? "").split(",").filter(name => name);
        this.tick = /^\d+$/.test(tick) ? Number(tick) : 0;
        if (!/^\d+$/.test(tick))
            faults.push(`there is no tick "${shownName(tick)}"`);
        for (const name of names.filter(name => !eventBits([name])))
            faults.push(`there is no event "${shownName(name)}"`);
        this.viewer.filter = eventBits(names);
        this.pending = Object.fromEntries(PARTS_OF_MODULE.map(name => [name, parts.get(name) ?? ""]));
        this.faults = faults;
        this.interaction.showExact(parts.get("pixels") === "recorded");
        if (this.interaction.isLive)
            this.applyView();
        this.viewer.goTo(this.tick);
        if (this.interaction.isLive)
            this.opening = this.apply().finally(() => this.opening = undefined);
        if (this.interaction.canPlay)
            return;
        if (Object.values(this.pending).some(part => part))
            this.faults.push("this page cannot draw another view than the recorded one");
        this.report();
    }

    /* Run an action that the address requests. If the action fails, its error is reported. */
    async attempt(act)
    {
        try {
            await act();
        } catch (error) {
            this.faults.push(error.message.replace(/^the (view|query):\d+: /, ""));
        }
    }

    /* Return the value of a part that waits for the module, and forget the part. */
    take(name)
    {
        const value = this.pending[name] ?? "";
        delete this.pending[name];
        return value;
    }

    /* Apply the view of the address, before the next picture. */
    applyView()
    {
        const view = this.take("view"), {interaction} = this;
        this.attempt(() => view === interaction.changedOptions(true) ||
                           interaction.look(viewOf(view, interaction.firstView)));
    }

    /* Apply the other parts of the address, after the picture of its tick. */
    async apply()
    {
        const {interaction} = this, keys = this.take("keys"), query = this.take("ask"), name = this.take("select");
        await interaction.show(this.viewer.tick);
        if (keys !== interaction.branchText)
            await this.attempt(() => interaction.playKeys(keys, this.tick));
        if (query)
            await this.attempt(() => interaction.ask(readQuery(query)));
        if (name !== this.viewer.inspector.name)
            await this.attempt(() => interaction.select(name));
        this.report();
    }

    report()
    {
        if (this.faults.length > 0)
            this.interaction.showStatus(`The address has a part that cannot be shown: ${this.faults.join("; ")}.`);
        this.faults = [];
    }

    /* ---- Writing -------------------------------------------------------------------------------------------------- */

    /* The parts of the address that differ from the first view of the page, as [name, value]. */
    parts()
    {
        const {viewer, interaction, pending} = this;
        return [["filter", viewer.filterNames().join(",")],
                ["view", pending.view ?? interaction.changedOptions(true)],
                ["keys", pending.keys ?? interaction.branchText],
                ["ask", pending.ask ?? interaction.asked ?? ""],
                ["select", pending.select ?? viewer.inspector.name ?? ""],
                ["pixels", interaction.exact ? "recorded" : ""]].filter(([, value]) => value);
    }

    writeSoon()
    {
        clearTimeout(this.writing);
        this.writing = setTimeout(() => this.write(), ADDRESS_DELAY);
    }

    write()
    {
        const parts = this.parts().map(([name, value]) => `&${name}=${encoded(value)}`);
        history.replaceState(null, "", `#t=${this.viewer.tick}${parts.join("")}`);
    }

    async copy()
    {
        const {opened} = this.interaction, own = opened ? ` It opens this page without ${shownName(opened)}.` : "";
        this.write();
        try {
            await navigator.clipboard.writeText(location.href);
            this.interaction.showStatus(`The link is copied.${own}`);
        } catch {
            this.interaction.showStatus("The browser does not let this page copy: copy its address, which is the link.");
        }
    }
}
