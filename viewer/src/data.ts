// Reads the packed numbers of the page: the other side of crates/view/src/block.rs.

import { FORMAT, type ModeInfo, type Packed, type PageInfo, type SceneInfo, type SecondInfo } from "./format";

/** Numbers of one kind at all instants: instant by instant, thing by thing, its components. */
export interface Track {
  components: number;
  things: number;
  ranges: [number, number][];
  values: Float32Array;
}

/** A natural mode, unpacked. */
export interface Mode extends Omit<ModeInfo, "stations" | "bodies" | "places"> {
  stations: { place: Track; turn: Track };
  bodies: { place: Track; turn: Track };
  places: Map<string, Track>;
}

export interface Column {
  name: string;
  unit: string;
  values: Float64Array;
}

/** All that the page shows. */
export interface Data {
  program: string;
  scene: SceneInfo;
  notes: string[];
  times: Float64Array;
  tracks: Map<string, Track>;
  /** Places and orientations of all stations as drawn. */
  drawn: { place: Float32Array; turn: Float32Array };
  stations: number;
  charts: { times: Float64Array; columns: Column[]; groups: PageInfo["charts"]["groups"] };
  modes: Mode[];
  /** A run to compare with. */
  second?: Second;
}

/** A second run, with what the two runs are called. */
export interface Second {
  names: [string, string];
  data: Data;
}

/** The bytes of a base64 text of deflated bytes. */
export async function unpack(text: string): Promise<Uint8Array> {
  const compressed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A track: two planes of bytes, folded differences, taken twice from instant to instant and twice from thing to thing. */
export async function track(packed: Packed): Promise<Track> {
  const { components, things, ranges } = packed;
  const bytes = await unpack(packed.data);
  const count = bytes.length / 2;
  const width = components * things;
  const instants = width === 0 ? 0 : count / width;
  const values = new Float32Array(count);
  // Sums in it are modulo 65536 by themselves.
  const words = new Uint16Array(things * instants);
  for (let component = 0; component < components; component++) {
    const begin = component * words.length;
    for (let at = 0; at < words.length; at++) {
      const folded = (bytes[begin + at] << 8) | bytes[count + begin + at];
      words[at] = (folded >>> 1) ^ -(folded & 1);
    }
    for (let round = 0; round < 2; round++) {
      for (let at = instants; at < words.length; at++) words[at] += words[at - instants];
      for (let at = 1; at < words.length; at++) if (at % instants !== 0) words[at] += words[at - 1];
    }
    const [low, high] = ranges[component];
    const step = (high - low) / 65535;
    for (let thing = 0, at = 0; thing < things; thing++) {
      for (let instant = 0; instant < instants; instant++, at++) values[instant * width + thing * components + component] = low + step * words[at];
    }
  }
  return { components, things, ranges, values };
}

/** Doubles, exactly: eight planes of bytes, each double exclusive-or the one before. */
export async function doubles(text: string): Promise<Float64Array> {
  const bytes = await unpack(text);
  const count = bytes.length / 8;
  const values = new Float64Array(count);
  const words = new Uint32Array(values.buffer);
  let high = 0;
  let low = 0;
  for (let at = 0; at < count; at++) {
    const byte = (plane: number) => bytes[plane * count + at];
    high ^= (byte(0) << 24) | (byte(1) << 16) | (byte(2) << 8) | byte(3);
    low ^= (byte(4) << 24) | (byte(5) << 16) | (byte(6) << 8) | byte(7);
    // Every processor that runs a browser stores the lower half first.
    words[2 * at] = low;
    words[2 * at + 1] = high;
  }
  return values;
}

/** Everything, from the JSON in the page. */
export async function read(info: PageInfo): Promise<Data> {
  if (info.format !== FORMAT) throw new Error(`the data have format ${info.format}, this program reads format ${FORMAT}`);
  const all = async (packed: Record<string, Packed>) =>
    new Map(await Promise.all(Object.entries(packed).map(async ([name, own]): Promise<[string, Track]> => [name, await track(own)])));
  const pair = async (packed: { place: Packed; turn: Packed }) => ({
    place: await track(packed.place),
    turn: await track(packed.turn),
  });
  const drawn = await Promise.all(info.scene.beams.map((beam) => pair(beam.drawn)));
  const join = (parts: Float32Array[]) => {
    const whole = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
    parts.reduce((at, part) => (whole.set(part, at), at + part.length), 0);
    return whole;
  };
  return {
    program: info.program,
    scene: info.scene,
    notes: info.notes,
    times: await doubles(info.times),
    tracks: await all(info.tracks),
    drawn: { place: join(drawn.map((own) => own.place.values)), turn: join(drawn.map((own) => own.turn.values)) },
    stations: info.scene.beams.reduce((most, beam) => Math.max(most, beam.stations[1]), 0),
    charts: {
      times: await doubles(info.charts.times),
      columns: await Promise.all(
        info.charts.columns.map(async ({ name, unit, data }) => ({ name, unit, values: await doubles(data) })),
      ),
      groups: info.charts.groups,
    },
    modes: await Promise.all(
      info.modes.map(async (mode) => ({ ...mode, stations: await pair(mode.stations), bodies: await pair(mode.bodies), places: await all(mode.places) })),
    ),
  };
}

/** A second run, from the JSON in the page. */
export async function readSecond({ names, data }: SecondInfo): Promise<Second> {
  return { names, data: await read(data) };
}
