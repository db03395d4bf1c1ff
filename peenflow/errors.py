"""What can go wrong, in the user's words: one paragraph each, with its exit status."""


class PeenflowError(Exception):
    """A failure the user can act on: what is wrong, where (file, key, line), what to do."""

    exit_status = 1


class InputError(PeenflowError):
    """The case, a file it names, an option or a missing tool is at fault."""

    exit_status = 2


class RunError(PeenflowError):
    """The input was right, the run was not: a process died, a figure diverged, a disk was full."""

    exit_status = 1
