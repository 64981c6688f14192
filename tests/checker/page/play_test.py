#!/usr/bin/env python3
"""The page that simulates in a real browser, from a file: its numbers are those of the command line, to the nanosecond;
any moment can be stepped to and back from; what it cannot read it refuses with the place; it asks no network for anything.

usage: play_test.py --build DIR --program STORMPROOF [--has-play 0|1] [--screenshots DIR]
Builds the page first. Exit code: 0, 1 if something differs, 77 if there is no such target (no emscripten, no node) or no
chromium.
"""
import argparse
import base64
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import urlencode

from browser import Browser

SOURCE = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(SOURCE / "specs/site"))
from build import Site  # noqa: E402 - as the site links to the page

OWN = """deployment: {hosts: 3, participants_per_host: 2, endpoints_per_participant: 8}
dds: {base: jazzy, spdp: {startup_announcements: 2}}
wireless: {base: wifi-80211n, source_queue_bytes: 65536}
time_limit: 30s
"""
ADDRESSES = [
    urlencode({"scenario": "wifi-5x20-fastdds"}),
    "",  # the controls as they are at first
    urlencode({"scenario": "wifi-5x20"}),
    urlencode({"scenario": "staggered-joins"}),
    urlencode({"exhibit": "E3"}),
    urlencode({"dds": "cyclonedds-0.10", "robots": 3, "processes": 2, "seed": 5}),
    urlencode({"dds": "fastdds-3.6", "spread": 2017, "buffer": 65536}),
    urlencode({"yaml": OWN}),
]
DONE = "['done', 'refused'].includes(document.body?.dataset.state) && document.body.dataset.state"

failures = []


def expect(what, got, wanted):
    if got != wanted:
        failures.append(f"{what}: {got}, expected {wanted}")


def simulated(program, yaml, *options):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scenario.yaml"
        file.write_text(yaml, encoding="utf-8")
        done = subprocess.run([program, "simulate", file, "--format", "json", *options], capture_output=True, text=True)
        if done.returncode not in (0, 1, 3):
            sys.exit(f"stormproof simulate: {done.stderr}\n{yaml}")
        return json.loads(done.stdout)


def compare(browser, page, program, address):
    browser.open(f"{page}#{address}")
    if browser.wait_for(DONE) == "refused":
        failures.append(f"{address}: refused, {browser.evaluate('error.textContent')}")
        return
    yaml = browser.evaluate("$('yaml').value")
    film = browser.evaluate("({...film, known: 0, pictures: 0})")
    # One scenario as it is; those that are drawn also under the first seeds, in the other worker.
    browser.wait_for("samples.length >= (scenario.is_drawn ? 3 : 1)")
    samples = browser.evaluate("samples.slice(0, scenario.is_drawn ? 3 : 1)")
    drawn = browser.evaluate("scenario.is_drawn")
    seed = browser.evaluate("scenario.seed")
    runs = [(film, simulated(program, yaml, "--samples", "1", "--seed", str(seed)))] if drawn else [(film, None)]
    if drawn:
        wanted = simulated(program, yaml, "--samples", "3", "--seed", "0")["samples"]
        pairs = [(film, runs[0][1]["samples"][0]), *zip(samples, wanted)]
    else:
        pairs = [(film, simulated(program, yaml)), (samples[0], simulated(program, yaml))]
    for got, expected in pairs:
        for key in ("t_disc_ns", "events", "user_control", "end"):
            expect(f"{address} {key}", got[key], expected[key])
        for key, value in got["counts"].items():
            expect(f"{address} {key}", value, expected["counts"][key])
    print(f"#{address[:90]}: {film['t_disc_ns']} ns, {film['events']} events, {len(pairs)} runs compared")


def findings(browser, page, program):
    """What the site links to from findings is what their commands simulate."""
    links = set()
    for finding in sorted((SOURCE / "specs/findings").glob("*.md")):
        text = Site(SOURCE, program.resolve(), Path(), True).with_play(finding.read_text(encoding="utf-8"))
        links.update(re.findall(r"\]\(\.\./\.\./play\.html#([^)]*)\)", text))
    expect("findings lead to the page", len(links) >= 12, True)
    for address in sorted(links):
        compare(browser, page, program, address)


def step(browser):
    """Forwards and back, by keys and buttons; the state of a moment does not depend on the way to it."""
    browser.evaluate("stopPlaying(), moveTo(5000)")
    browser.wait_for("document.body.dataset.moment === '5000'")
    before = browser.evaluate("$('what').textContent + $('readers').textContent")
    for key, wanted in (("ArrowRight", "5001"), ("ArrowRight", "5002"), ("ArrowLeft", "5001"), ("ArrowLeft", "5000")):
        browser.evaluate(f"document.body.dispatchEvent(new KeyboardEvent('keydown', {{key: '{key}', bubbles: true}}))")
        browser.wait_for(f"document.body.dataset.moment === '{wanted}'")
    expect("back at event 5000", browser.evaluate("$('what').textContent + $('readers').textContent"), before)
    browser.evaluate("$('on-own').click()")
    own = browser.wait_for("Number(document.body.dataset.moment) > 5000 && document.body.dataset.moment")
    expect("a step of its own", browser.evaluate("document.querySelectorAll('#what tr.mine').length > 0"), True)
    expect("rules named", browser.evaluate("document.querySelectorAll('#what code').length > 0"), True)
    browser.evaluate("$('back-own').click()")
    browser.wait_for(f"Number(document.body.dataset.moment) < {own}")
    expect("machine drawn", browser.evaluate("$('drawing').firstChild.shadowRoot.querySelectorAll('rect.active').length > 0"), True)


def refuse(browser, page):
    """A mistake is told with its place, and nothing is shown for it."""
    for yaml, wanted in (("deployment: {hosts: 2", "expected ',' or '}'"), ("deployment: {hosts: 1}\ndds: nonsense", "scenario:2:6")):
        browser.open(f"{page}#{urlencode({'yaml': yaml})}")
        expect(yaml, browser.wait_for(DONE), "refused")
        said = browser.evaluate("$('error').textContent")
        if wanted not in said:
            failures.append(f"{yaml!r}: says {said!r}, expected {wanted!r} in it")


def start_page(browser, script):
    """The recorded storm moves, and leads to the page."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "index.html"
        file.write_text(f'<!doctype html><body><div id="storm"></div><script src="{script.resolve().as_uri()}"></script>', encoding="utf-8")
        browser.open(file.as_uri())
        browser.wait_for("document.querySelector('canvas') !== null")
        browser.evaluate("window.first = document.querySelector('canvas').toDataURL()")
        browser.wait_for("document.querySelector('canvas').toDataURL() !== first")
        expect("the start page leads to", browser.evaluate("document.querySelector('#storm a').getAttribute('href')"),
               f"play.html#{ADDRESSES[0]}")
        expect("the start page says", browser.evaluate("document.querySelector('#storm').textContent.includes('STORM')"), True)


def look(browser, page, folder):
    """No page scrolls sideways, at any width, light or dark."""
    for width in (400, 1280, 1920):
        for scheme in ("light", "dark"):
            browser.send("Emulation.setDeviceMetricsOverride", width=width, height=1000, deviceScaleFactor=1, mobile=False)
            browser.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme},
                                                                 {"name": "prefers-reduced-motion", "value": "reduce"}])
            browser.open(f"{page}#scenario=wifi-5x20-fastdds")
            expect(f"{width} {scheme}", browser.wait_for(DONE), "done")
            browser.evaluate("seek(60)")
            browser.wait_for("document.body.dataset.moment === String(film.pictures[60][1])")
            expect(f"{width} {scheme} fits", browser.evaluate("document.documentElement.scrollWidth <= innerWidth"), True)
            if folder:
                browser.wait_for("samples.length > 3")
                shot = browser.send("Page.captureScreenshot", captureBeyondViewport=True, clip={
                    "x": 0, "y": 0, "width": width, "height": browser.evaluate("document.documentElement.scrollHeight"), "scale": 1})
                (folder / f"play-{width}-{scheme}.png").write_bytes(base64.b64decode(shot["data"]))
    browser.send("Emulation.clearDeviceMetricsOverride")
    browser.send("Emulation.setEmulatedMedia", features=[])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--has-play", type=int, default=1)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--screenshots", type=Path)
    given = parser.parse_args()
    if not given.has_play or not shutil.which("chromium"):
        print("skipped: emscripten, node or chromium is missing (cmake/debian-packages.txt: play, test)")
        return 77
    jobs = {"CMAKE_BUILD_PARALLEL_LEVEL": os.environ.get("STORMPROOF_JOBS", "1")}  # other tests run beside it
    subprocess.run(["cmake", "--build", given.build, "--target", "play"], check=True, env={**os.environ, **jobs})
    file = (given.build / "play/play.html").resolve()
    page = file.as_uri()
    expect("compressed, at most 1.5 MB", len(gzip.compress(file.read_bytes())) <= 1_500_000, True)
    browser = Browser()
    try:
        for address in ADDRESSES:
            compare(browser, page, given.program, address)
        findings(browser, page, given.program)
        browser.open(f"{page}#{ADDRESSES[0]}")
        browser.wait_for(DONE)
        step(browser)
        refuse(browser, page)
        start_page(browser, given.build / "play/storm.js")
        look(browser, page, given.screenshots)
        failures.extend(browser.complaints)
    finally:
        browser.close()
    print("\n".join(failures) or "the page says what the command line says", file=sys.stderr if failures else sys.stdout)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
