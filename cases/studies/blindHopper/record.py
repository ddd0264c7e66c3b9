"""The record: what is kept only so that it can be checked, in one archive.

record.tar.xz holds, of the sets that have been opened, the sealed files, the truths and the answers, byte for byte as
they were committed. Of sets that are still sealed they lie in sealed/ and results/; `./pack` moves them into the
archive. Each file is read from where it is; one that is in both places must be the same in both. """

import functools
import hashlib
import io
import lzma
import tarfile
from pathlib import Path
from typing import Dict, List, Optional

HERE = Path(__file__).resolve().parent
ARCHIVE = HERE / "record.tar.xz"
HASHES_OF_ANSWERS = HERE / "answers.sha256"  # lines "hash  results/SET/report.json", of the answers in the archive


@functools.lru_cache(maxsize=None)
def archived() -> Dict[str, bytes]:
    """{path from this folder: content} of the archive."""
    if not ARCHIVE.exists():
        return {}
    with tarfile.open(ARCHIVE) as tar:
        files = {member.name: tar.extractfile(member) for member in tar.getmembers()}
        return {name: file.read() for name, file in files.items() if file is not None}


def read(path: str) -> Optional[bytes]:
    """Content of a file of the record; None where there is none."""
    loose = (HERE / path).read_bytes() if (HERE / path).exists() else None
    kept = archived().get(path)
    if loose is not None and kept is not None and loose != kept:
        raise SystemExit(f"{HERE / path}: this is not the file of that name in {ARCHIVE.name}; remove one of them")
    return kept if loose is None else loose


def paths() -> List[str]:
    """Of all files of the record, wherever they are."""
    loose = [
        path
        for pattern in ("sealed/*.json.enc", "truth/*.json", "results/*/**/report.json")
        for path in HERE.glob(pattern)
    ]
    return sorted({str(path.relative_to(HERE)) for path in loose} | set(archived()))


def answer(path: str) -> bytes:
    """A report.json; one of the archive must have its committed hash."""
    content = read(path)
    if content is None:
        raise SystemExit(f"{HERE / path}: there is no such answer, neither here nor in {ARCHIVE.name}")
    if path in archived() and digest(content) != hashes(HASHES_OF_ANSWERS).get(path):
        raise SystemExit(f"{HERE / path}: this is not what was answered: its hash is not that of {HASHES_OF_ANSWERS}")
    return content


def write(files: Dict[str, bytes], archive: Path = ARCHIVE) -> None:
    """The archive: the same bytes from the same files, whoever packs them and when."""
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for path in sorted(files):
            member = tarfile.TarInfo(path)  # no owner, time 0
            member.size = len(files[path])
            member.mode = 0o644
            tar.addfile(member, io.BytesIO(files[path]))
    archive.write_bytes(lzma.compress(stream.getvalue(), preset=9 | lzma.PRESET_EXTREME))
    archived.cache_clear()


def hashes(file: Path) -> Dict[str, str]:
    """{path: hash} of a file as sha256sum writes it."""
    lines = file.read_text().splitlines() if file.exists() else []
    return {path: digest_of_line for digest_of_line, path in (line.split() for line in lines)}


def digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
