"""What can go wrong, in the user's words: one paragraph each, with its exit status."""

import unicodedata

LONGEST = 2400  # characters of a message
_CONTROLS = {"Cc", "Cf", "Cs", "Zl", "Zp"}  # Unicode categories: line ends, escapes, marks that turn text round


class PeenflowError(Exception):
    """A failure the user can act on: what is wrong, where (file, key, line), what to do."""

    exit_status = 1

    def __init__(self, message: str) -> None:
        """Keep the message to one line of a length a person reads, whatever names and values from files it quotes."""
        line = "".join(_escaped(character) if is_control(character) else character for character in message)
        super().__init__(shortened(line, LONGEST))


class InputError(PeenflowError):
    """The case, a file it names, an option or a missing tool is at fault."""

    exit_status = 2


class RunError(PeenflowError):
    """The input was right, the run was not: a process died, a figure diverged, a disk was full."""

    exit_status = 1


def is_control(character: str) -> bool:
    """Whether a terminal, a log or a page would obey it instead of showing it."""
    return unicodedata.category(character) in _CONTROLS


def shortened(text: str, longest: int) -> str:
    """The text without its middle where a value or name makes it long: what to do stands at the end."""
    half = longest // 2
    return text if len(text) <= longest else f"{text[:half]} … {text[-half:]}"


def _escaped(character: str) -> str:
    return " " if character == "\n" else character.encode("unicode_escape").decode()
