"""Text of `parameters` that a shell would run."""

import functools
import shlex
from typing import Any

from clepsydra.environment import REPOSITORY
from developers.fault_kinds.bench import Bench
from developers.fault_kinds.kinds import Wrong, fault

HOSTILE = (
    "x $(touch made)|e #",
    "`touch made`",
    "1|e touch made #",
    "$(touch made)",
    "1; touch made",
    "a[$(touch made)0]",
    "'; touch made; '",
    "1\ntouch made",
    'system("touch made")',
    "__import__('os').system('touch made')",
)


@fault(
    "an entry of parameters is text that a shell, sed, awk or Python would run",
    "no command is run; refused or kept as text",
)
def hostile_parameters(bench: Bench) -> list[Any]:
    return [
        functools.partial(hostile, bench, use, text)
        for text in bench.some(HOSTILE, quick=3)
        for use in ("get", "set", "merge", "at")
    ]


def hostile(bench: Bench, use: Any, text: str) -> str:
    folder = bench.fresh_folder("hostile")
    (folder / "parameters").write_text(f"friction            {text if use != 'set' else 1};\nother 1;\n")
    (folder / "template").write_text("friction            0.1;\nother 2;\n")
    action = {
        "get": 'value=$(parameter friction) && echo "$value"',
        "set": f"setParameter parameters friction {shlex.quote(text)}",
        "merge": "parameterFile merge template parameters",
        "at": f"at {shlex.quote(text)}",
    }[use]
    functions = REPOSITORY / "scripts" / "runFunctions"
    script = f"set -eu; repository={shlex.quote(str(REPOSITORY))}; . {functions}; {action}"
    outcome = bench.call(["bash", "-c", script], folder)
    if any(path.name == "made" for path in folder.rglob("*")):
        raise Wrong(f"{use}: {text!r} was run")
    if "Traceback" in outcome.output or "command not found" in outcome.output:
        raise Wrong(f"{use}: {text!r}: " + outcome.last_words)
    return "not run"
