"""What the studies share that print tables: in Markdown, so that they can be pasted into a README."""


def print_table(title, columns, rows):
    """Rows of texts; the first column to the left, the others to the right."""
    rows = list(rows)
    widths = [max(map(len, cells)) for cells in zip(columns, *rows)]

    def line(cells):
        return "| " + " | ".join(f"{text:{'<' if n == 0 else '>'}{widths[n]}}" for n, text in enumerate(cells)) + " |"

    print(f"\n{title}\n\n{line(columns)}")
    print("|" + "|".join("-" * (width + 1) + ("-" if n == 0 else ":") for n, width in enumerate(widths)) + "|")
    for row in rows:
        print(line(row))
    print(flush=True)
