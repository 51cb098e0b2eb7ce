/* SPDX-License-Identifier: MIT */
/* address.js - the page's address holds what the page shows, so that a link opens exactly this:
 *   #t=41&filter=collided,full&view=--camera+top+--zoom+2&pixels=recorded
 * `view` has the options of the command line that turn the recorded view into the shown one; the value "none" removes a
 * member of the view. A wrong part of an address is ignored, with a sentence. */
"use strict";

/* Milliseconds between two changes of the page's address: browsers refuse an address that changes with each frame. */
const ADDRESS_DELAY = 200;

/* Write text as the value of an address. Characters that are readable and allowed stay as they are. */
const encoded = text => encodeURIComponent(text).replace(/%(20|2C|3A|2F|3D)/g, code => code === "%20" ? "+" : decodeURIComponent(code));

class Address {
    constructor(viewer)
    {
        this.viewer = viewer;
        this.pending = {}; /* the parts that wait for the module, by name */
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
        if (!/^\d+$/.test(tick))
            faults.push(`there is no tick "${shownName(tick)}"`);
        for (const name of names.filter(name => !eventBits([name])))
            faults.push(`there is no event "${shownName(name)}"`);
        this.viewer.filter = eventBits(names);
        this.pending = {view: parts.get("view") ?? ""};
        this.faults = faults;
        this.interaction.showExact(parts.get("pixels") === "recorded");
        if (this.interaction.isLive || !this.interaction.canPlay)
            this.apply();
        this.viewer.goTo(Math.trunc(Number(tick)) || 0);
    }

    /* Apply the parts of the address that need the module, before the next picture, and report what is wrong with the
     * address. */
    apply()
    {
        const {view = ""} = this.pending, {interaction} = this;
        this.pending = {};
        try {
            if (interaction.isLive && view !== interaction.changedOptions(true))
                interaction.look(viewOf(view, interaction.recorded.about));
        } catch (error) {
            this.faults.push(error.message.replace(/^the view:\d+: /, ""));
        }
        if (this.faults?.length > 0)
            interaction.showStatus(`The address has something that cannot be shown: ${this.faults.join("; ")}.`);
        this.faults = [];
    }

    /* ---- Writing -------------------------------------------------------------------------------------------------- */

    /* The parts of the address that differ from the first view of the page, as [name, value]. */
    parts()
    {
        const {viewer, interaction} = this;
        return [["filter", viewer.filterNames().join(",")],
                ["view", this.pending.view ?? interaction.changedOptions(true)],
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
        this.write();
        try {
            await navigator.clipboard.writeText(location.href);
            this.interaction.showStatus("The link is copied.");
        } catch {
            this.interaction.showStatus("The browser does not let this page copy: copy its address, which is the link.");
        }
    }
}
