// Names beside the things that they name.

import * as THREE from "three";
import { h } from "./dom";
import type { Player } from "./player";

interface Label {
  element: HTMLElement;
  place: () => THREE.Vector3;
}

export class Labels {
  private readonly layer = h("div", { class: "labels", "aria-hidden": "true", hidden: true });
  private readonly labels: Label[];

  constructor(private readonly player: Player, parent: HTMLElement) {
    const { scene } = player.data;
    const from = (name: Parameters<typeof this.at>[0], number: number) => () => this.at(name, number);
    const named = (kind: string, name: string, place: () => THREE.Vector3): Label => ({ element: h("span", { class: kind }, name), place });
    this.labels = [
      ...scene.beams.map(({ name, stations: [begin, end] }) => named("beam", name, from("station.place", (begin + end) >> 1))),
      ...scene.bodies.map(({ name }, k) => named("body", name, from("body.place", k))),
      ...scene.joints.map(({ name }, k) => named("joint", name, from("joint.place", k))),
      ...scene.frames.map((name, k) => named("frame", name, from("frame.place", k))),
      ...(scene.ropes ?? []).map(({ name, points }) => named("rope", name, () => this.at("rope.place", (points[0] + points[1] - 1) >> 1))),
      ...scene.springs.map((name, k) => named("spring", name, () => this.at("spring.a", k).add(this.at("spring.b", k)).multiplyScalar(0.5))),
      ...scene.loads.map(({ name, arrows }) => named("load", name, from("load.place", arrows[0]))),
      ...scene.points.map((name, k) => named("point", name, from("point.place", k))),
    ];
    this.layer.append(...this.labels.map(({ element }) => element));
    parent.append(this.layer);
  }

  private at(name: "station.place" | "body.place" | "joint.place" | "frame.place" | "spring.a" | "spring.b" | "load.place" | "point.place" | "rope.place", number: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.player.moment.parts[name], 3 * number);
  }

  show(on: boolean): void {
    this.layer.hidden = !on;
    this.player.refresh();
  }

  /** Puts each name beside its thing; those at one place one under the other. */
  update(): void {
    if (this.layer.hidden) return;
    const taken: { x: number; y: number }[] = [];
    for (const { element, place } of this.labels) {
      const { x, y, visible } = this.player.stage.project(place());
      const at = { x: x + 10, y: y - 8 };
      while (taken.some((other) => Math.abs(other.x - at.x) < 60 && Math.abs(other.y - at.y) < 14)) at.y += 15;
      taken.push(at);
      element.style.transform = `translate(${at.x}px, ${at.y}px)`;
      element.hidden = !visible;
    }
  }
}
