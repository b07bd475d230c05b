"""Rapier: 2-D, single precision, in Rust; here as WebAssembly in Node, see peer_rapier.mjs."""

import json
import os
import subprocess
from dataclasses import asdict
from pathlib import Path

from stepping import bouncing
from systems import REPOSITORY, Motion

MODULES = Path(os.environ.get("RAPIER", str(REPOSITORY / "target/peers/node_modules")))
PACKAGE = json.loads((MODULES / "@dimforge/rapier2d-compat/package.json").read_text())
NAME = f"Rapier {PACKAGE['version']}"
# Its default step and a finer one.
SETTINGS = {"step 1/60 s": 1 / 60, "step 0.1 ms": 1e-4}


def motion(stage, step, times):
    marks = {round(time / step): time for time in times}
    given = {**asdict(stage), "step": step, "steps": round(stage.until / step), "marks": list(marks), "sleeps": True}
    command = ["node", str(Path(__file__).with_suffix(".mjs")), str(MODULES / "here.js")]
    done = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    states = {marks[int(count)]: [tuple(state) for state in states] for count, states in found["found"].items()}
    path = [((count + 1) * step, state) for count, state in enumerate(found["path"])]
    return Motion(states, path=path, spent=found["seconds"])


bounce = bouncing(motion)
