"""Tables in Markdown, and times."""

import resource

# A run that takes longer than this is timed once, a shorter one three times, for the least of them. In seconds.
LONG = 1.0


def processor():
    """Seconds of processor time of this process and the programs it has run."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def timed(function):
    """What the function gives, and the processor time it takes in seconds."""
    result, spent = None, []
    while len(spent) < 3 and sum(spent) < LONG:
        begin = processor()
        result = function()
        spent.append(getattr(result, "spent", None) or processor() - begin)
    return result, min(spent)


def error(found, expected):
    """The size of an error, in two digits."""
    if found is None:
        return "none"
    size = abs(found - expected)
    return f"{size:.1e}" if size else "0"


def rough(seconds):
    """A time to one digit."""
    rounded = float(f"{seconds * 1000:.0e}")
    return f"{rounded / 1000:g} s" if rounded >= 1000 else f"{rounded:g} ms"


def show(title, head, rows):
    print(f"\n### {title}\n")
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
