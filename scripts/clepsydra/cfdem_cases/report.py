"""What an import found: carried over with another meaning, left out, or an error."""


class Report:
    def __init__(self, known=()):
        self.changes, self.omissions, self.errors = [], [], []
        self.without = set(known)  # entries that the user wants left out, whatever they say
        self.used = set()

    def change(self, where, what, how):
        self.changes.append((where, what, how))

    def left_out(self, where, what, why):
        self.omissions.append((where, what, why))

    def error(self, where, what, why):
        """Unless the user has said --without for it."""
        if what in self.without:
            self.used.add(what)
            self.left_out(where, what, "by --without")
        else:
            self.errors.append((where, what, why))

    def lines(self):
        for title, rows in (("Means something else here", self.changes), ("Left out", self.omissions)):
            if rows:
                yield f"{title}:"
                yield from (f"  {where}: {what}: {how}" for where, what, how in dict.fromkeys(rows))
