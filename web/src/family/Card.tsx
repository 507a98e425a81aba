// One asset: its picture, name, number of hulls, and signs for how it stands, each a shape of its own with its words
// behind it.
import { Boxes } from "lucide-react";
import { memo, type MouseEvent, useState } from "react";
import { Thumbnail } from "../pictures/Thumbnail";
import { openDecompose } from "../store/decompose";
import { useIsDecomposing } from "../store/jobs";
import { useSelectedPositions } from "../store/familySelection";
import { doubtsText, probabilityText } from "../store/assessment";
import { isBare } from "../store/family";
import { useProject } from "../store/project";
import { extendSheet, toggleOnSheet } from "../store/sheet";
import { countText } from "../store/words";
import { openAsset, setLayout, useWorkspace } from "../store/workspace";
import { Button } from "../ui/Button";
import type { Card as CardData } from "../wire";
import css from "./card.module.css";
import { type Badge, badgesOf, cardText, fitBadges, SIGNS } from "./cardText";

interface CardProps {
  asset: string;
  /** What is shown of its name. */
  name: string;
  /** How high the words below the picture are [px]. */
  words: number;
  width: number;
  place: number;
  of: number;
  large: boolean;
}

/** The id of a card's element, by which the list says which one is current. */
export const cardId = (asset: string): string => `card ${asset}`.replace(/\s/g, "_");

export const Card = memo(function Card({ asset, name, words, width, place, of, large }: CardProps) {
  const card = useProject((state) => state.cards[asset]);
  const current = useWorkspace((workspace) => workspace.asset === asset);
  const inView = useWorkspace(({ sheet }) => sheet.includes(asset));
  const selected = useSelectedPositions(asset);
  const engine = useWorkspace((workspace) => workspace.checks.engine);
  const doubts = useProject((state) => doubtsText(asset, state.confidence[asset], state.assessment?.threshold ?? null));
  const bare = useProject((state) => isBare(state.cards));
  const sure = useProject((state) => probabilityText(state, asset));
  if (!card) return null;
  const badges = badgesOf(card, engine, bare);
  const title = [doubts, ...badges.map(({ text }) => text)].join("\n");
  const description = [cardText(card, engine), sure && sure !== "…" && `${sure} sure`, selected?.length && `${countText(selected.length, "hull")} selected`].filter(Boolean).join("; ");
  // the folder, which all assets share, is in the tooltip only
  const broken = (
    <p className={css.error} title={card.error ?? undefined} aria-hidden>
      {card.error?.replace(/^\S*[/\\](?=\S+:)/, "")}
    </p>
  );
  return (
    <div
      id={cardId(asset)}
      role="option"
      aria-selected={current || inView}
      data-beside={(inView && !current) || undefined}
      aria-posinset={place + 1}
      aria-setsize={of}
      data-asset={asset}
      className={css.card}
      data-state={card.error === null ? "fine" : "broken"}
      style={{ width }}
      title={title}
      onClick={(event) => clickCard(event, asset)}
      onDoubleClick={() => setLayout({ gallery: false })}
    >
      <span className="visually-hidden">{description}</span>
      {card.error === null ? <Face card={card} large={large} selected={selected} /> : broken}
      <div className={css.foot} style={{ height: words }} aria-hidden>
        <span className={css.name}>{name}</span>
        <span className={css.line}>
          <Amount card={card} />
          <Sure asset={asset} />
          <Badges all={badges} room={width - 104} />
        </span>
      </div>
    </div>
  );
});

/** A click opens an asset; with Ctrl it comes beside those in view or goes, with Shift all up to it come. */
function clickCard({ shiftKey, ctrlKey, metaKey }: MouseEvent, asset: string): void {
  const isLabelling = useWorkspace.getState().stage === "label";
  if (isLabelling && shiftKey) extendSheet(asset);
  else if (isLabelling && (ctrlKey || metaKey)) toggleOnSheet(asset);
  else openAsset(asset);
}

interface FaceProps {
  card: CardData;
  large: boolean;
  /** Its selected hulls while hulls of several assets are selected. */
  selected: readonly number[] | undefined;
}

/** The picture: of the output where results are looked at and there is one; under the pointer, of what was before. */
function Face({ card, large, selected }: FaceProps) {
  const [over, setOver] = useState(false);
  const results = useWorkspace((workspace) => workspace.stage === "review" && workspace.highlight === null);
  const pointed = useWorkspace((workspace) => (workspace.highlight ? (workspace.highlight.assets[card.asset] ?? NONE) : undefined));
  const marked = pointed ?? (selected?.length === 0 ? NONE : selected);
  const isKnown = marked !== NONE;
  const edited = results && card.edited_picture !== null && card.output !== "failed";
  const showing = edited && !(large && over) ? "output" : "source";
  if (card.hulls === null) return <div className={css.skeleton} aria-hidden />;
  const makes = card.hulls === 0 && card.sources > 0 && <MakeHulls asset={card.asset} />;
  if (makes && card.picture === null) return <div className={css.bare}>{makes}</div>;
  return (
    <div className={css.face} onPointerEnter={() => setOver(true)} onPointerLeave={() => setOver(false)}>
      <Thumbnail asset={card.asset} of={showing} highlight={marked} label="" />
      {marked && isKnown && card.hulls > 0 && <span className={css.marked} aria-hidden>{marked.length}</span>}
      {makes && <span className={css.over}>{makes}</span>}
      {large && edited && <span className={css.which} aria-hidden>{showing === "output" ? "after" : "before"}</span>}
    </div>
  );
}

const NONE: readonly number[] = [];

function Amount({ card }: { card: CardData }) {
  if (card.hulls === null) return <span className={css.amount}>{card.error === null ? "reading…" : "unreadable"}</span>;
  if (card.after === null || card.output === "none") return <span className={css.amount}>{countText(card.hulls, "hull")}</span>;
  return (
    <span className={css.amount}>
      {card.hulls} → {card.after}
    </span>
  );
}

/** The probability that its edit is right. */
function Sure({ asset }: { asset: string }) {
  const text = useProject((state) => probabilityText(state, asset));
  const held = useProject((state) => state.assessment !== null && state.confidence[asset]?.state === "needs review");
  return text === null ? null : (
    <span className={css.sure} data-held={held} aria-hidden>
      {text}
    </span>
  );
}

/** The button that cuts the geometry of an asset into hulls. */
function MakeHulls({ asset }: { asset: string }) {
  const making = useIsDecomposing();
  return (
    <Button
      icon={Boxes}
      tip="Decompose its geometry into convex hulls: settings, and a try"
      disabled={making}
      onClick={(event) => {
        event.stopPropagation();
        openDecompose(asset);
      }}
    >
      Make hulls
    </Button>
  );
}

/** room: for signs and their counts [px]. */
function Badges({ all, room }: { all: readonly Badge[]; room: number }) {
  return (
    <span className={css.badges}>
      {fitBadges(all, room).map(({ name, count, old }) => {
        const { Icon } = SIGNS[name];
        return (
          <span key={name} className={css.badge} data-badge={name} data-old={old}>
            <Icon size={12} aria-hidden />
            {count}
          </span>
        );
      })}
    </span>
  );
}
