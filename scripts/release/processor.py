"""Programs run on every x86-64 processor: no instruction of a later one, except in functions chosen at run time.

    processor.py FILE…      programs and libraries that are not stripped
"""

from __future__ import annotations

import re
import subprocess
import sys
from typing import Dict, List

# What came after x86-64's first version. tzcnt is not there: a processor without it takes it for bsf, as compilers mean it.
_LATER = re.compile(
    r"v[a-z0-9]+|popcnt|lzcnt|movbe|crc32[bwlq]?|cmpxchg16b|andn|bextr|bls[ir]|blsmsk|bzhi|mulx|pdep|pext|rorx|s[ahl][rl]x|adcx|adox|"
    r"addsubp[ds]|hadd?p[ds]|hsubp[ds]|lddqu|movddup|movs[hl]dup|pabs[bwd]|palignr|pshufb|psign[bwd]|phadd[a-z]+|phsub[a-z]+|"
    r"pmaddubsw|pmulhrsw|blendv?p[ds]|dpp[ds]|extractps|insertps|mpsadbw|packusdw|pblendvb|pblendw|pcmpeqq|pcmpgtq|pextr[bdq]|"
    r"pinsr[bdq]|pm(?:ax|in)(?:s[bd]|u[wd])|pmov[sz]x[a-z]+|pmuldq|pmulld|ptest|rounds?[ps]?[ds]|pcmp[ei]str[im]|aes[a-z0-9]+|pclmul[a-z]*"
)
# Not of the vector unit, though they begin with v.
_OLD = re.compile(r"verr|verw")
_PREFIXES = {"lock", "rep", "repz", "repnz", "bnd", "data16", "cs", "notrack"}
# A function for one kind of processor, as compilers name what target_clones makes.
_CHOSEN = re.compile(r"\.(?:avx|sse4|arch_)[a-z0-9_]*(?:\.|$)")


def later_instructions(file: str) -> Dict[str, List[str]]:
    """The functions with instructions of later processors, and which these are."""
    found: Dict[str, List[str]] = {}
    function = ""
    with subprocess.Popen(
        ["objdump", "--disassemble", "--no-show-raw-insn", file], stdout=subprocess.PIPE, text=True, errors="replace"
    ) as listing:
        assert listing.stdout is not None
        for line in listing.stdout:
            if line.endswith(">:\n"):
                function = line[line.index("<") + 1 : -3]
                continue
            words = line.split("\t", 2)
            mnemonics = [m for m in words[1].split()[:2] if m not in _PREFIXES] if len(words) > 1 else []
            if mnemonics and _LATER.fullmatch(mnemonics[0]) and not _OLD.fullmatch(mnemonics[0]):
                found.setdefault(function, []).append(mnemonics[0])
    if not function:
        raise SystemExit(f"{file}: objdump shows no function")
    return found


def main() -> None:
    for file in sys.argv[1:]:
        functions = later_instructions(file)
        wrong = {f: sorted(set(i)) for f, i in functions.items() if not _CHOSEN.search(f)}
        if wrong:
            shown = "\n".join(f"  {f}: {', '.join(i)}" for f, i in sorted(wrong.items())[:20])
            raise SystemExit(
                f"{file} has instructions that not every x86-64 processor knows, in {len(wrong)} functions:\n{shown}"
            )
        print(f"{file}: x86-64 as it began, except for {len(functions)} functions that are chosen at run time")


if __name__ == "__main__":
    main()
