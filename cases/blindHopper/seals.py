"""The sealed truth, its committed hashes, and what of it has been opened."""

import hashlib
import json
import os
from pathlib import Path

HERE = Path(__file__).resolve().parent
SEALED = Path(os.environ.get("BLIND_SEALED", HERE / "work/sealed.json"))
HASHES = HERE / "truth.sha256"      # lines "hash  name": of sealed.json, and of each set's part, truth/SET.json
OPENED = HERE / "truth"


def content(part):
    return (json.dumps(part, indent=1) + "\n").encode()


def hashes(truth):
    """A set's part has 54 drawn seeds of eight digits: nobody finds it by trying."""
    parts = {"sealed.json": truth, **{f"truth/{name}.json": part for name, part in truth["sets"].items()}}
    return "".join(f"{hashlib.sha256(content(part)).hexdigest()}  {name}\n" for name, part in parts.items())


def committed():
    """{name: hash}"""
    return {name: digest for digest, name in (line.split() for line in HASHES.read_text().splitlines())}


def open(name):
    """What is in a set, from truth/SET.json or else from the sealed file, which it is then copied from."""
    path = OPENED / f"{name}.json"
    part = path.read_bytes() if path.exists() else content(json.loads(SEALED.read_text())["sets"][name])
    if hashlib.sha256(part).hexdigest() != committed()[f"truth/{name}.json"]:
        raise SystemExit(f"{path}: this is not what was sealed: its hash is not that of {HASHES}")
    if not path.exists():
        OPENED.mkdir(exist_ok=True)
        path.write_bytes(part)
    return json.loads(part)
