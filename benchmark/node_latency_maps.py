"""Maps for node_latency: seeded, as bytes, row 0 first; 0 free, 100 occupied, 255 (-1) unknown."""
import random

RESOLUTION = 0.05  # m
FREE, OCCUPIED = 0, 100


class Map:
    def __init__(self, name, side, cells, origin=(0.0, 0.0)):
        self.name, self.width, self.height = name, side, len(cells) // side
        self.cells, self.origin = cells, origin

    def copy(self):
        return Map(self.name, self.width, bytearray(self.cells), self.origin)

    def at(self, column, row):
        return self.cells[row * self.width + column]

    def set(self, column, row, value):
        self.cells[row * self.width + column] = value

    def fill(self, column, row, width, height, value):
        width = min(width, self.width - column)
        for line in range(row, min(row + height, self.height)):
            begin = line * self.width + column
            self.cells[begin:begin + width] = bytes([value]) * width

    def centre(self, column, row):
        return (self.origin[0] + (column + 0.5) * RESOLUTION, self.origin[1] + (row + 0.5) * RESOLUTION)

    def cell(self, x, y):
        return int((x - self.origin[0]) / RESOLUTION), int((y - self.origin[1]) / RESOLUTION)

    def cell_entered(self, x, y):
        """The cell that a path enters there; None near its border, since a path may touch the corner of a blocked cell."""
        along, up = (x - self.origin[0]) / RESOLUTION, (y - self.origin[1]) / RESOLUTION
        return (int(along), int(up)) if max(abs(along % 1.0 - 0.5), abs(up % 1.0 - 0.5)) < 0.3 else None

    def grown(self, by):
        """With so many free columns and rows more before the first."""
        side = self.width + by
        grown = Map(self.name, side, bytearray(side * (self.height + by)),
                    (self.origin[0] - by * RESOLUTION, self.origin[1] - by * RESOLUTION))
        for row in range(self.height):
            begin = (row + by) * side + by
            grown.cells[begin:begin + self.width] = self.cells[row * self.width:(row + 1) * self.width]
        return grown


def city(side, seed):
    """Blocks of buildings of all sizes between streets of 1.5 m."""
    generator = random.Random(seed)
    made = Map("city", side, bytearray(side * side))
    street, block = 30, 90
    for row in range(street, side - street, block + street):
        for column in range(street, side - street, block + street):
            width = min(generator.randint(block // 2, block), side - street - column)
            height = min(generator.randint(block // 2, block), side - street - row)
            made.fill(column, row, width, height, OCCUPIED)
    return made


def warehouse(side, seed):
    """Long shelves with aisles of 2 m, some of them with a gap, and pallets in the aisles."""
    generator = random.Random(seed)
    made = Map("warehouse", side, bytearray(side * side))
    aisle, depth = 40, 16
    for row in range(aisle, side - aisle, depth + aisle):
        made.fill(aisle, row, side - 2 * aisle, depth, OCCUPIED)
        for _ in range(max(1, side // 512)):
            made.fill(generator.randrange(aisle, side - 2 * aisle), row, aisle, depth, FREE)
        pallet = generator.randrange(aisle, side - 2 * aisle)
        made.fill(pallet, row + depth + aisle // 2 - 3, 6, 6, OCCUPIED)
    return made


def scattered(before, share, generator, spare):
    """A copy with a share of its free cells occupied, away from the places in `spare`."""
    changed = before.copy()
    for _ in range(int(share * len(before.cells))):
        column, row = generator.randrange(before.width), generator.randrange(before.height)
        if all(max(abs(column - c), abs(row - r)) > 40 for c, r in spare):
            changed.set(column, row, OCCUPIED if changed.at(column, row) == FREE else FREE)
    return changed


KINDS = {"city": city, "warehouse": warehouse}


def from_pgm(file_name):
    """A binary PGM of map_server's kind: its first line is the last row; dark is occupied."""
    import re
    with open(file_name, "rb") as file:
        image = file.read()
    head = re.match(rb"P5\s(?:#[^\n]*\n)*(\d+)\s+(\d+)\s+(\d+)\s", image)
    if not head:
        raise SystemExit("node_latency: %s is no binary PGM" % file_name)
    width, height = int(head.group(1)), int(head.group(2))
    table = bytes(OCCUPIED if value < 90 else FREE if value > 205 else 255 for value in range(256))
    pixels = image[head.end():head.end() + width * height].translate(table)
    rows = [pixels[row * width:(row + 1) * width] for row in reversed(range(height))]
    return Map(file_name.rsplit("/", 1)[-1], width, bytearray(b"".join(rows)))
