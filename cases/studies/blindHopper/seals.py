"""The sealed truth, its committed hashes, and what of it has been opened: as files, or in the record (record.py)."""

import hashlib
import json
import os
import subprocess
from pathlib import Path
from typing import Any

import old_names
import record

HERE = Path(__file__).resolve().parent
SEALED = Path(os.environ.get("BLIND_SEALED", HERE / "sealed"))  # SET.json.enc of what has not been opened
HASHES = HERE / "truth.sha256"  # lines "hash  truth/SET.json"; the first eight had one more, of a file of them all
OPENED = HERE / "truth"


def content(part: Any) -> bytes:
    return (json.dumps(part, indent=1) + "\n").encode()


def seal(truth: Any) -> None:
    """{set: what is in it} into sealed files, and their hashes to the committed ones. A set's part has many drawn seeds
    of eight digits: nobody finds it by trying."""
    SEALED.mkdir(parents=True, exist_ok=True)
    for name, part in truth.items():
        (SEALED / f"{name}.json.enc").write_bytes(cipher(name, content(part)))
    lines = "".join(f"{hashlib.sha256(content(part)).hexdigest()}  truth/{name}.json\n" for name, part in truth.items())
    HASHES.write_text((HASHES.read_text() if HASHES.exists() else "") + lines)


def cipher(name: str, data: Any, *direction: Any) -> Any:
    """The key is the set's name: whoever wants to can read it, but nobody does by looking at the repository, in which
    it stays from one day of measuring to the next."""
    command = ["openssl", "enc", "-aes-256-cbc", "-pbkdf2", "-pass", f"pass:{name}", *direction]
    return subprocess.run(command, input=data, stdout=subprocess.PIPE, check=True).stdout


def unsealed(name: str) -> Any:
    """What a set holds, for the generator that measures it, and for who opens it."""
    path = SEALED / f"{name}.json.enc"
    sealed = path.read_bytes() if path.exists() else record.archived().get(f"sealed/{name}.json.enc")
    if sealed is None:
        raise SystemExit(f"{path}: there is no such file, and none of that name in {record.ARCHIVE.name}")
    return cipher(name, sealed, "-d")


def is_sealed_file_kept(name: str) -> bool:
    """The sealed files of the first two draws were never committed."""
    return (SEALED / f"{name}.json.enc").exists() or f"sealed/{name}.json.enc" in record.archived()


def truth_of(part: Any) -> Any:
    """What is in a set, with today's names."""
    return old_names.today(json.loads(part))


def committed() -> Any:
    """{name: hash}"""
    return record.hashes(HASHES)


def set_names() -> list[Any]:
    return [name[len("truth/") : -len(".json")] for name in committed() if name.startswith("truth/")]


def is_open(name: str) -> bool:
    return record.read(f"truth/{name}.json") is not None


def open(name: str) -> Any:
    """What is in a set, from truth/SET.json or else from its sealed file, which it is then copied from."""
    path = OPENED / f"{name}.json"
    part = record.read(f"truth/{name}.json") or unsealed(name)
    if hashlib.sha256(part).hexdigest() != committed()[f"truth/{name}.json"]:
        raise SystemExit(f"{path}: this is not what was sealed: its hash is not that of {HASHES}")
    if not is_open(name):
        OPENED.mkdir(exist_ok=True)
        path.write_bytes(part)
    return truth_of(part)
