"""beside.py -- see beside.sh, which made the pages."""
from browser import Browser
from checks import check, end

PAGE = "a #%41 page.html"
# Of each frame on the finest level: the columns' names and sums.
ALL = """(async () => {
    const out = [];
    for (const frame of mrView.frames) {
        const columns = {};
        for (const c of frame.columns.values())
            if (c.layer && c.type !== "t")
                columns[c.layer + "." + c.name] = (await c.values()).reduce((a, x) => a + x, 0);
        out.push([frame.name, frame.file, frame.group, columns]);
    }
    return out;
})()"""


def choose(b, model):
    b.eval("(e => { e.selectedIndex = %d; e.dispatchEvent(new Event('change')) })(document.getElementById('model'))"
        % model)
    b.settle()


def pictures(b, page):
    """Of each model that is there; then the values of all frames."""
    b.open(page)
    seen = []
    for model in 2, 1, 0, 1:
        choose(b, model)
        seen.append(b.picture())
        check(b.text("message") == "", "%s: model %d: %s" % (page, model, b.text("message")))
    b.press("ArrowRight")
    seen.append(b.picture())
    return seen, b.eval("[...document.querySelectorAll('#model option')].map(e => e.textContent)"), b.eval(ALL)


with Browser() as browser:
    pictures_of_one, titles, frames = pictures(browser, "one.html")
    films = browser.eval("mrView.frames.length")
    also, names, beside = pictures(browser, PAGE)
    check(names == titles and len(names) == 4, "models: %s, not %s" % (names, titles))
    check(len(beside) == len(frames) == films == 8, "%d frames, not %d" % (len(beside), films))
    check(also == pictures_of_one, "the models look otherwise than in one page")
    check(beside[:5] == frames[:5], "the frames have other values than in one page")
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
    choose(browser, 3)
    check(browser.text("message").endswith("not beside the page: a%20%23%2541%20page.4.js"),
        "a model that is not there: " + browser.text("message"))
    choose(browser, 0)
    check(browser.text("message") == "" and browser.picture() == also[2], "the first model is not shown again")
end()
