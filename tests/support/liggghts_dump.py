"""LIGGGHTS' dumps as text, written by hand: contacts (compute wall/gran/local pos vel id force delta) and spins."""

from collections.abc import Mapping, Sequence

COLUMNS = "".join(f"c_contacts[{column}] " for column in range(1, 20))  # a blank ends this line and each row
SNAPSHOT = f"""\
ITEM: TIMESTEP
{{}}
ITEM: NUMBER OF ENTRIES
{{}}
ITEM: BOX BOUNDS ff ff ff
-0.006 0.006
-0.006 0.006
-0.001 0.003
ITEM: ENTRIES {COLUMNS}
"""
CONTACT = "0.1 0.2 0 0.1 0.2 0.3 0 0 -2 1 2 -62.5 {} 7 3 0 0 9.25 1.5e-7 \n"  # of shot number 3 on facet 7 of a mesh


def snapshot(step: int, *rows: str) -> str:
    """What one output writes; each row ends in a line break."""
    return SNAPSHOT.format(step, len(rows)) + "".join(rows)


def dump(rows: Mapping[int, Sequence[str]], last: int, interval: int) -> str:
    """Outputs of steps 0, `interval`, … `last`, with the rows of each; most are empty."""
    return "".join(snapshot(step, *rows.get(step, ())) for step in range(0, last + 1, interval))


SPINS = """\
ITEM: TIMESTEP
{}
ITEM: NUMBER OF ATOMS
{}
ITEM: BOX BOUNDS ff ff ff
-0.006 0.006
-0.006 0.006
-0.001 0.003
ITEM: ATOMS id omegax omegay omegaz tqx tqy tqz{}
"""


def spins(rows: Mapping[int, Sequence[str]], last: int, interval: int) -> str:
    """The dump of the shots that something rubs, beside that of the contacts."""
    steps = range(0, last + 1, interval)
    return "".join(SPINS.format(step, len(rows.get(step, ())), " ") + "".join(rows.get(step, ())) for step in steps)


WHOLE = dump({2: [CONTACT.format(0), CONTACT.format(1)], 4: [CONTACT.format(0)]}, 4, 2)
