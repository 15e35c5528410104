"""What the plots of the benchmarks have in common: tables in, page and colours out."""
import csv

# Of Okabe and Ito; they stay apart for colour-blind eyes.
COLOURS = {"thermedge": "#0072B2", "OpenCV": "#D55E00", "classical": "#777777"}


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def replace_between(path, marker, text):
    begin, end = f"<!-- {marker} -->", f"<!-- end of {marker} -->"
    page = path.read_text(encoding="utf-8")
    if begin not in page or end not in page:
        raise SystemExit(f"{path}: should hold the lines {begin} and {end}")
    head, rest = page.split(begin)
    tail = rest.split(end)[1]
    path.write_text(f"{head}{begin}\n{text}\n{end}{tail}", encoding="utf-8")


def table(header, rows, left=1):
    """Markdown; the first `left` columns are text, the others numbers."""
    line = lambda cells: "| " + " | ".join(str(cell) for cell in cells) + " |"
    rule = "|" + "---|" * left + "---:|" * (len(header) - left)
    return "\n".join([line(header), rule] + [line(row) for row in rows])
