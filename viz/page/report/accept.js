/* SPDX-License-Identifier: MIT */
/* accept.js - the selection of frames to accept, and accept.txt, which lists them for octreel accept --from: one name
 * on each line. */
"use strict";

/* Quote a text so that a shell reads it as one word. */
const shellWord = text => /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;

class Selection {
    constructor(findings)
    {
        this.findings = findings;
        this.selected = new Set();
        this.boxes = findings.frames.map((finding, i) => this.makeBox(finding, i));
        document.getElementById("select-all").addEventListener("click", () => this.toggleAll());
        document.getElementById("save").addEventListener("click", () => this.save());
        document.getElementById("copy").addEventListener("click", () => this.copy());
        this.show();
    }

    /* Whether a frame can be accepted. An unreadable frame cannot become a reference, and accept.txt cannot hold a name
     * with a line break. */
    isAcceptable(i)
    {
        const {finding, frames} = this.findings.frames[i];
        return finding !== "unreadable" && !frames.some(name => /[\n\r]/.test(name));
    }

    makeBox(finding, i)
    {
        const box = element("input", "", {type: "checkbox", "aria-label": `Accept ${titleOf(finding)}`,
                                          title: "accept (a)"});
        box.disabled = !this.isAcceptable(i);
        box.addEventListener("change", () => this.set(i, box.checked));
        return box;
    }

    set(i, on)
    {
        if (!this.isAcceptable(i))
            return;
        this.selected[on ? "add" : "delete"](i);
        this.show();
    }

    toggle(i)
    {
        this.set(i, !this.selected.has(i));
    }

    toggleAll()
    {
        const all = this.boxes.map((_, i) => i).filter(i => this.isAcceptable(i));
        this.selected = new Set(this.selected.size < all.length ? all : []);
        this.show();
    }

    show()
    {
        const names = this.names().length, {compared, reference} = this.findings.whole;
        const reason = reference.kind === "baseline" ? " --reason \"...\"" : "";
        this.boxes.forEach((box, i) => box.checked = this.selected.has(i));
        document.getElementById("selected").textContent =
            `${grouped(this.selected.size)} selected, ${grouped(names)} ${names === 1 ? "frame" : "frames"}`;
        document.getElementById("accept-how").textContent = names === 0 ? "" :
            `octreel accept ${shellWord(reference.path)} ${shellWord(compared.path)} --from accept.txt${reason}`;
        for (const id of ["save", "copy"])
            document.getElementById(id).disabled = names === 0;
    }

    names()
    {
        return [...this.selected].sort((a, b) => a - b).flatMap(i => this.findings.frames[i].frames);
    }

    text()
    {
        return this.names().map(name => `${name}\n`).join("");
    }

    save()
    {
        const link = element("a", "", {href: URL.createObjectURL(new Blob([this.text()], {type: "text/plain"})),
                                       download: "accept.txt"});
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href));
    }

    /* Copy the text to the clipboard. A page that was opened as a file may have no navigator.clipboard. */
    async copy()
    {
        try {
            await navigator.clipboard.writeText(this.text());
        } catch {
            const area = document.body.appendChild(element("textarea", this.text(), {class: "hidden"}));
            area.select();
            document.execCommand("copy");
            area.remove();
        }
        document.getElementById("spoken").textContent = "Copied";
    }
}
