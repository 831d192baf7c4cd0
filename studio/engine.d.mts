export class EngineStopped extends Error {}

export interface Stage {
  done: number;
  of: number;
  name: string;
}

export interface Refusal {
  message: string;
  remedy: string | null;
  place: { file: string; line: number; column: number } | null;
}

export interface EngineFile {
  path: string;
  bytes: Uint8Array<ArrayBuffer>;
}

export interface Reply {
  answer?: unknown;
  files?: EngineFile[];
  refused?: Refusal;
}

export class Engine {
  static load(source: BufferSource | WebAssembly.Module, onStage?: (stage: Stage) => void): Promise<Engine>;
  ask(request: object, files?: Record<string, Uint8Array | string>): Reply;
}
