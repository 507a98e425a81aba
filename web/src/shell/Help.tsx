// All commands with their keys, and how it goes in four lines.
import { X } from "lucide-react";
import { Dialog } from "radix-ui";
import { type ReactNode, useState } from "react";
import type { Command } from "../commands/command";
import { foldCommands, listCommands } from "../commands/list";
import { SIGNS } from "../family/cardText";
import { startTour } from "../store/tour";
import { Button, IconButton } from "../ui/Button";
import { close, Overlay } from "./Overlay";
import css from "./overlay.module.css";

const GROUPS: readonly Command["group"][] = ["Go", "Select", "View", "Label", "Demonstrate", "Learn", "Review", "Edit"];

const HOW = [
  ["Label", "Label hulls: select them and press a digit, on a few assets or on all."],
  ["Demonstrate", "On one or two assets, select hulls and choose an action, step by step."],
  ["Learn", "MeshForge finds the program that does the same. Answer its questions until every result is sure, or was looked at."],
  ["Review", "Apply the program to the family, accept each result or call it wrong, and export."],
] as const;

export const Help = () => (
  <Overlay which="help">
    <Content />
  </Overlay>
);

function Content() {
  const [search, setSearch] = useState("");
  const word = search.trim().toLowerCase();
  const fits = (command: Command) =>
    !word || `${command.title} ${command.group} ${command.keys.join(" ")}`.toLowerCase().includes(word);
  const groups = GROUPS.map((group) => ({ group, commands: listCommands().filter((one) => one.group === group && fits(one)) }));
  const none = groups.every(({ commands }) => commands.length === 0);
  return (
    <>
      <header className={css.head}>
        <Dialog.Title className={css.title}>Keys and help</Dialog.Title>
        <input
          type="search"
          className={css.field}
          placeholder="Find a command or key"
          aria-label="Find a command or key"
          value={search}
          onChange={(event) => setSearch(event.target.value)}
        />
        <Button
          onClick={() => {
            close();
            startTour();
          }}
        >
          Guided tour
        </Button>
        <IconButton icon={X} name="Close" keys="Escape" onClick={close} />
      </header>
      <div className={css.scroll} tabIndex={0}>
        {!word && <How />}
        {none && <p className={css.none}>No command matches.</p>}
        <div className={css.groups}>
          {groups
            .filter(({ commands }) => commands.length > 0)
            .map(({ group, commands }) => (
              <Commands key={group} name={group} commands={commands} />
            ))}
          {!word && <Signs />}
        </div>
      </div>
    </>
  );
}

function How() {
  return (
    <ol className={css.how} aria-label="How it works">
      {HOW.map(([name, text], k) => (
        <li key={name}>
          <span className={css.number}>{k + 1}</span>
          <span>
            <b>{name}.</b> {text}
          </span>
        </li>
      ))}
    </ol>
  );
}

/** What the signs on the cards of the family mean. */
function Signs() {
  return (
    <Group name="Signs on the cards of the family">
      {Object.entries(SIGNS).map(([name, { Icon, meaning }]) => (
        <Row key={name} what={meaning}>
          <Icon size={14} role="img" aria-label={name} />
        </Row>
      ))}
    </Group>
  );
}

function Commands({ name, commands }: { name: string; commands: readonly Command[] }) {
  return (
    <Group name={name}>
      {foldCommands(commands).map(({ id, title, keys }) => (
        <Row key={id} what={title}>
          {keys.map((key) => (
            <kbd key={key}>{key}</kbd>
          ))}
        </Row>
      ))}
      {name === "Go" && (
        <Row what="Next part of the window, previous">
          <kbd>F6</kbd> <kbd>Shift+F6</kbd>
        </Row>
      )}
    </Group>
  );
}

function Group({ name, children }: { name: string; children: ReactNode }) {
  return (
    <div className={css.group} role="group" aria-label={name}>
      <h3>{name}</h3>
      <dl>{children}</dl>
    </div>
  );
}

function Row({ what, children }: { what: string; children: ReactNode }) {
  return (
    <div className={css.pair}>
      <dt>{what}</dt>
      <dd>{children}</dd>
    </div>
  );
}
