/* SPDX-License-Identifier: MIT */
/* drive_tradeoff.js - uses the trade's page like a reader, and reports what it shows, after drive.js. */
"use strict";

const chapter = document.getElementById("index").parentElement;
const charts = [...chapter.querySelectorAll(".chart")];
const marks = () => charts[0].querySelectorAll(".mark").length;
const press = (target, key) => target.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
const choose = (list, value) => {
    list.value = value;
    list.dispatchEvent(new Event("change"));
};

/* Give a file to the field that compares pages. */
async function layOver(name, text)
{
    const input = document.getElementById("other"), files = new DataTransfer(), status = document.querySelector("[role=status]");
    files.items.add(new File([text], name));
    input.files = files.files;
    const before = status.textContent;
    input.dispatchEvent(new Event("change"));
    await until(() => status.textContent !== before, "the other page");
    return status.textContent;
}

run(async () => {
    say("chapters and gains", document.querySelectorAll("main section").length);
    say("title", document.querySelector("h1").textContent);
    const all = marks();
    say("has marks", all > 10);
    const octreel = [...chapter.querySelectorAll(".legend button")].find(button => button.textContent === "octreel");
    octreel.click();
    say("fewer without octreel", marks() < all);
    octreel.click();
    say("all again", marks() === all);
    press(charts[0].querySelector("svg"), "ArrowRight");
    say("first point", /^octreel, uniform \/ nearest \/ random: setting 0, recall 1,/.test(charts[0].querySelector(".said").textContent));
    press(charts[0].querySelector("svg"), "ArrowLeft");
    say("last point", charts[0].querySelector(".said").textContent.split(",")[0]);
    const lists = chapter.querySelectorAll("select");
    say("lists", lists.length);
    choose(lists[1], "box");
    say("nothing about distances of a box", charts[1].querySelector(".said").textContent);
    say("marks of a box", marks() > 0);
    choose(lists[1], "nearest");
    const matrix = document.querySelector(".matrix");
    say("rows of the matrix", matrix.rows.length);
    say("octreel is never wrong", [...matrix.rows].slice(1).every(row => ["right", "refused"].includes(row.cells[2].textContent)));
    const details = chapter.querySelector("details");
    details.open = true;
    await until(() => details.querySelector("table"), "the table");
    say("rows of the table", details.querySelectorAll("tr").length > 100);
    say("not a page", await layOver("other.html", "<p>no page</p>"));
    const both = await layOver("same.html", document.documentElement.outerHTML);
    say("another page", /^Hollow marks: \d{4}-/.test(both));
    say("twice the marks", marks() === 2 * all);
    say("fits", document.documentElement.scrollWidth <= innerWidth);
});
